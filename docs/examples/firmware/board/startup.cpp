// From reset to main on a Cortex-M, and what a compiler may call on its own in a program without a C library.
#include <cstddef>
#include <cstdint>

#include "semihosting.hpp"

extern "C" {

// Of image.ld.
extern std::uint32_t image_stack_top;
extern std::uint32_t image_data_load;
extern std::uint32_t image_data_begin;
extern std::uint32_t image_data_end;
extern std::uint32_t image_bss_begin;
extern std::uint32_t image_bss_end;

int main();

// Plain loops; the attribute keeps the compiler from turning them into calls of themselves.
#define BOARD_NO_LOOP_PATTERNS __attribute__((used, optimize("no-tree-loop-distribute-patterns")))

BOARD_NO_LOOP_PATTERNS void* memcpy(void* to, const void* from, std::size_t count) {
    auto* out = static_cast<unsigned char*>(to);
    const auto* in = static_cast<const unsigned char*>(from);
    while (count-- > 0) *out++ = *in++;
    return to;
}

BOARD_NO_LOOP_PATTERNS void* memmove(void* to, const void* from, std::size_t count) {
    auto* out = static_cast<unsigned char*>(to);
    const auto* in = static_cast<const unsigned char*>(from);
    if (out <= in) return memcpy(to, from, count);
    while (count-- > 0) out[count] = in[count];
    return to;
}

BOARD_NO_LOOP_PATTERNS void* memset(void* to, int value, std::size_t count) {
    auto* out = static_cast<unsigned char*>(to);
    while (count-- > 0) *out++ = static_cast<unsigned char>(value);
    return to;
}

[[noreturn]] void reset_handler() {
#if defined(__ARM_FP)
    // The floating-point unit is off at reset: full access to coprocessors 10 and 11 in the register CPACR.
    *reinterpret_cast<volatile std::uint32_t*>(0xE000ED88u) |= 0xFu << 20;
    asm volatile("dsb\n isb" ::: "memory");
#endif
    const std::uint32_t* load = &image_data_load;
    for (std::uint32_t* word = &image_data_begin; word < &image_data_end;) *word++ = *load++;
    for (std::uint32_t* word = &image_bss_begin; word < &image_bss_end;) *word++ = 0;
    board::exit_with(static_cast<std::uint32_t>(main()));
}

[[noreturn]] void fault_handler() {
    board::print("fault: the core stopped on an illegal access or instruction\n");
    board::exit_with(101);
}

using Handler = void (*)();

struct VectorTable {
    const void* stack_top;
    Handler handlers[15];
};

// clang-format off
extern const VectorTable image_vectors;
__attribute__((section(".vectors"), used)) const VectorTable image_vectors = {
    &image_stack_top,
    {reset_handler, fault_handler, fault_handler, fault_handler, fault_handler, fault_handler, nullptr, nullptr, nullptr,
     nullptr, fault_handler, fault_handler, nullptr, fault_handler, fault_handler}};
// clang-format on

}  // extern "C"
