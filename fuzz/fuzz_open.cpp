// Any bytes: opened as they are, then with magic, version, size and checksum made to fit, so that the fuzzer reaches
// what lies behind them. Whatever opens is asked everything. Bytes behind the size that the header states are what the
// arguments of the queries are made of.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <span>

#include <espalier/espalier.hpp>

#include "judge.hpp"
#include "support/base/checksum.hpp"
#include "support/machine/exact_buffer.hpp"
#include "target.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

namespace header = format::header;

std::uint32_t get(std::span<const std::byte> bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (unsigned i = 0; i < 4; ++i) value |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
    return value;
}

void put(std::span<std::byte> bytes, std::size_t at, std::uint32_t value) {
    for (unsigned i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::byte>(value >> (8 * i));
}

/// How many of the bytes are the blob: all, if the header does not say.
std::size_t blob_size(std::span<const std::byte> bytes) {
    if (bytes.size() < header::bytes) return bytes.size();
    const std::uint32_t stated = get(bytes, header::total_bytes_at);
    return stated >= header::bytes && stated <= bytes.size() ? stated : bytes.size();
}

/// So that only what is behind the first checks decides.
void repair(std::span<std::byte> blob) {
    put(blob, header::magic_at, format::magic);
    put(blob, header::version_major_at, format::version_major | std::uint32_t{format::version_minor} << 16);
    put(blob, header::total_bytes_at, static_cast<std::uint32_t>(blob.size()));
    repair_checksum(blob);
}

void open_and_ask(std::span<const std::byte> bytes, std::span<const std::byte> arguments) {
    const Blob blob = open(bytes);
    if (!blob) {
        if (blob.triangle_count() != 0 || detail::data_of(blob).bytes != nullptr)
            fuzz::fail("open", "refused and not empty");
        return;
    }
    Random random(bytes.size(), arguments);
    fuzz::judge(bytes, blob, random);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto all = std::as_bytes(std::span(data, size));
    const std::size_t blob_bytes = blob_size(all);
    const auto arguments = all.subspan(blob_bytes);
    // The exact-size copy lies at an address that the input chooses.
    ExactBuffer buffer(all.first(blob_bytes), size % 16);
    open_and_ask(buffer.bytes(), arguments);
    if (blob_bytes < header::bytes) return 0;
    const bool as_it_was = std::equal(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(blob_bytes),
                                      (repair(buffer.bytes()), buffer.bytes().begin()));
    if (!as_it_was) open_and_ask(buffer.bytes(), arguments);
    return 0;
}

#if defined(ESPALIER_FUZZ)

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

constexpr std::uint32_t hostile_integers[] = {0,          1,          2,          0xFF,       0x100,      0xFFFF,
                                              0x10000,    0xFFFFFF,   0x1000000,  0x7FFFFFFF, 0x80000000, 0x80000001,
                                              0xFFFFFFFE, 0xFFFFFFFF, 0x7F7FFFFF, 0x7F800000, 0x7FC00000, 0x00800000};

/// A word of the header, of a node or of the leaves: one more, one less, a bit, or a number that breaks careless code.
void change_a_word(std::span<std::byte> blob, Random& random) {
    const std::uint32_t nodes = std::min(get(blob, header::node_count_at), 64u);
    const auto profile = static_cast<Profile>(std::to_integer<std::uint8_t>(blob[header::profile_at]));
    const std::size_t node_bytes = format::node_bytes(profile);
    std::size_t at = 4 * std::size_t{random.below(static_cast<std::uint32_t>(blob.size() / 4))};
    if (random.coin()) {
        const bool is_in_node = random.coin();
        at = 4 * std::size_t{random.below(static_cast<std::uint32_t>((is_in_node ? node_bytes : header::bytes) / 4))};
        if (is_in_node) at += header::bytes + node_bytes * random.below(nodes + 1);
    }
    if (at + 4 > blob.size()) return;
    std::uint32_t word = get(blob, at);
    switch (random.below(4)) {
        case 0:
            word += random.coin() ? 1u : 0xFFFFFFFFu;
            break;
        case 1:
            word ^= 1u << random.below(32);
            break;
        case 2:
            word = (word & 0xFFFFFF00u) | random.below(256);
            break;
        default:
            word = hostile_integers[random.below(std::size(hostile_integers))];
    }
    put(blob, at, word);
}

}  // namespace

/// Changes the blob or the arguments, and repairs what the first checks of `open` would stop at.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
    Random random(seed);
    const auto bytes_of = [&](std::size_t count) { return std::as_writable_bytes(std::span(data, count)); };
    std::size_t blob_bytes = blob_size(bytes_of(size));
    const std::size_t argument_bytes = size - blob_bytes;
    if (size >= header::bytes && random.below(3) == 0) {  // other arguments
        const std::size_t room = std::min<std::size_t>(max_size - blob_bytes, 512);
        const std::size_t changed = LLVMFuzzerMutate(data + blob_bytes, std::min(argument_bytes, room), room);
        repair(bytes_of(blob_bytes));
        return blob_bytes + changed;
    }
    if (size >= header::bytes && random.below(2) == 0) {
        for (std::uint32_t i = 0; i <= random.below(3); ++i) change_a_word(bytes_of(blob_bytes), random);
        repair(bytes_of(blob_bytes));
        return size;
    }
    // What is behind the blob moves along.
    std::uint8_t arguments[512];
    const std::size_t kept = std::min(argument_bytes, sizeof arguments);
    std::memcpy(arguments, data + blob_bytes, kept);
    const std::size_t room = max_size > kept ? max_size - kept : max_size;
    blob_bytes = LLVMFuzzerMutate(data, std::min(blob_bytes, room), room);
    if (blob_bytes < header::bytes || random.below(64) == 0) return blob_bytes;
    repair(bytes_of(blob_bytes));
    const std::size_t moved = std::min(kept, max_size - blob_bytes);
    std::memcpy(data + blob_bytes, arguments, moved);
    return blob_bytes + moved;
}

#endif
