// A plugin for QEMU that measures queries in an image from outside, exactly: instructions, bytes read of the blob,
// depth of the stack, and writes that went elsewhere. The image says where a query begins and ends by writing to a
// block of marks
// (../image/marks.hpp): the address of the write is the message. Counts are of instructions, not of cycles.
//
// query_meter.so,marks=ADDRESS,blob=ADDRESS,blob_size=BYTES,stack=ADDRESS,stack_size=BYTES
// prints at the end, for each kind of query that ran: "measured KIND calls C instructions MEAN MAX blob MEAN MAX stack
// MAX elsewhere WRITES", means rounded up.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>

// What we need of QEMU's plugin interface, which Debian installs no header for. These functions are the same in all its
// versions; the number is checked when the plugin is loaded, and measure.sh sets the one that the installed QEMU takes.
extern "C" {
#define EXPORTED __attribute__((visibility("default")))
using PluginId = std::uint64_t;
using MemoryInfo = std::uint32_t;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
using BlockTranslated = void(PluginId, qemu_plugin_tb*);
using Executed = void(unsigned, void*);
using Accessed = void(unsigned, MemoryInfo, std::uint64_t, void*);
using Ended = void(PluginId, void*);
void qemu_plugin_register_vcpu_tb_trans_cb(PluginId, BlockTranslated*);
void qemu_plugin_register_vcpu_tb_exec_cb(qemu_plugin_tb*, Executed*, int flags, void* data);
void qemu_plugin_register_vcpu_mem_cb(qemu_plugin_insn*, Accessed*, int flags, int reads_or_writes, void* data);
void qemu_plugin_register_atexit_cb(PluginId, Ended*, void* data);
std::size_t qemu_plugin_tb_n_insns(const qemu_plugin_tb*);
qemu_plugin_insn* qemu_plugin_tb_get_insn(const qemu_plugin_tb*, std::size_t);
unsigned qemu_plugin_mem_size_shift(MemoryInfo);
bool qemu_plugin_mem_is_store(MemoryInfo);
void qemu_plugin_outs(const char*);
EXPORTED int qemu_plugin_version = QUERY_METER_PLUGIN_VERSION;
}

namespace {

constexpr int no_registers = 0;
constexpr int reads_and_writes = 3;

struct Range {
    std::uint64_t first = 0, size = 0;
    [[nodiscard]] bool holds(std::uint64_t address) const { return address - first < size; }
};

constexpr unsigned mark_count = 64;
constexpr unsigned end_mark = mark_count - 1;
Range marks{0, mark_count * 4}, blob, stack;

struct Sum {
    std::uint64_t total = 0, most = 0;
    void add(std::uint64_t value) {
        total += value;
        most = std::max(most, value);
    }
    [[nodiscard]] unsigned long long mean_of(std::uint64_t count) const { return (total + count - 1) / count; }
};

struct Measured {
    std::uint64_t calls = 0;
    Sum instructions;
    Sum blob_bytes;
    Sum stack_bytes;
    std::uint64_t writes_elsewhere = 0;
};
Measured measured[mark_count];

// What runs now. Instructions are counted by blocks, when they are entered; what an instruction that touches memory has
// before it within its block is added where it does.
std::uint64_t instructions_before_block = 0;
std::uint64_t instructions_with_block = 0;
unsigned running = end_mark;
std::uint64_t began = 0;
std::uint64_t blob_bytes = 0;
std::uint64_t stack_top = 0;  // 0 until the first write to the stack, which tells it
std::uint64_t lowest = 0;

void enter_block(unsigned, void* data) {
    instructions_before_block = instructions_with_block;
    instructions_with_block += reinterpret_cast<std::uintptr_t>(data);
}

void begin(unsigned kind, std::uint64_t now) {
    running = kind;
    began = now;
    blob_bytes = 0;
    stack_top = 0;
}

void end(std::uint64_t now) {
    const unsigned kind = std::exchange(running, end_mark);
    if (stack_top == 0) return;  // the startup code, which clears the marks
    Measured& one = measured[kind];
    ++one.calls;
    one.instructions.add(now - began);
    one.blob_bytes.add(blob_bytes);
    one.stack_bytes.add(stack_top - lowest);
}

void touch(std::uint64_t address, unsigned size, bool is_store) {
    if (stack.holds(address)) {
        if (stack_top == 0 && is_store) stack_top = lowest = address + size;
        else lowest = std::min(lowest, address);
    } else if (is_store) {
        ++measured[running].writes_elsewhere;
    } else if (blob.holds(address)) {
        blob_bytes += size;
    }
}

void access(unsigned, MemoryInfo info, std::uint64_t address, void* data) {
    const bool is_store = qemu_plugin_mem_is_store(info);
    if (is_store && marks.holds(address)) {
        const std::uint64_t now = instructions_before_block + reinterpret_cast<std::uintptr_t>(data);
        const auto kind = static_cast<unsigned>((address - marks.first) / 4);
        if (kind != end_mark) begin(kind, now);
        else if (running != end_mark) end(now);
    } else if (running != end_mark) {
        touch(address, 1u << qemu_plugin_mem_size_shift(info), is_store);
    }
}

void block_translated(PluginId, qemu_plugin_tb* block) {
    const std::size_t count = qemu_plugin_tb_n_insns(block);
    qemu_plugin_register_vcpu_tb_exec_cb(block, enter_block, no_registers, reinterpret_cast<void*>(count));
    for (std::size_t i = 0; i < count; ++i)
        qemu_plugin_register_vcpu_mem_cb(qemu_plugin_tb_get_insn(block, i), access, no_registers, reads_and_writes,
                                         reinterpret_cast<void*>(i));
}

void print_all(PluginId, void*) {
    for (unsigned kind = 0; kind < end_mark; ++kind) {
        const Measured& one = measured[kind];
        if (one.calls == 0) continue;
        char line[256];
        std::snprintf(line, sizeof line,
                      "measured %u calls %llu instructions %llu %llu blob %llu %llu stack %llu elsewhere %llu\n", kind,
                      static_cast<unsigned long long>(one.calls), one.instructions.mean_of(one.calls),
                      static_cast<unsigned long long>(one.instructions.most), one.blob_bytes.mean_of(one.calls),
                      static_cast<unsigned long long>(one.blob_bytes.most),
                      static_cast<unsigned long long>(one.stack_bytes.most),
                      static_cast<unsigned long long>(one.writes_elsewhere));
        qemu_plugin_outs(line);
    }
}

}  // namespace

extern "C" EXPORTED int qemu_plugin_install(PluginId id, const void*, int argument_count, char** arguments) {
    const struct {
        const char* name;
        std::uint64_t& value;
    } known[] = {{"marks=", marks.first},
                 {"blob=", blob.first},
                 {"blob_size=", blob.size},
                 {"stack=", stack.first},
                 {"stack_size=", stack.size}};
    for (int i = 0; i < argument_count; ++i) {
        bool found = false;
        for (const auto& one : known) {
            const std::size_t length = std::strlen(one.name);
            if (std::strncmp(arguments[i], one.name, length) != 0) continue;
            one.value = std::strtoull(arguments[i] + length, nullptr, 0);
            found = true;
        }
        if (!found) return 1;
    }
    qemu_plugin_register_vcpu_tb_trans_cb(id, block_translated);
    qemu_plugin_register_atexit_cb(id, print_all, nullptr);
    return 0;
}
