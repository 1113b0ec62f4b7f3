// What the targets that open bytes share. An input is a blob or a scene, then bytes that arguments are made of. The
// headers of both have magic, version, size and checksum in the same places.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>

#include <espalier/format.hpp>

#include "support/base/checksum.hpp"
#include "support/base/random.hpp"
#include "support/machine/exact_buffer.hpp"

namespace espalier::fuzz {

inline constexpr std::size_t header_bytes = format::header::bytes;
static_assert(format::scene::header_bytes == header_bytes);
static_assert(format::scene::checksum_at == format::header::checksum_at);

inline std::uint32_t get(std::span<const std::byte> bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (unsigned i = 0; i < 4; ++i) value |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
    return value;
}

inline void put(std::span<std::byte> bytes, std::size_t at, std::uint32_t value) {
    for (unsigned i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::byte>(value >> (8 * i));
}

/// Returns how many bytes of an input are the blob or the scene: all, if its header states no size that fits.
inline std::size_t stated_size(std::span<const std::byte> input) {
    if (input.size() < header_bytes) return input.size();
    const std::uint32_t stated = get(input, format::header::total_bytes_at);
    return stated >= header_bytes && stated <= input.size() ? stated : input.size();
}

/// Writes magic, version, size and checksum, so that only what is behind the first checks decides.
inline void repair_header(std::span<std::byte> bytes, std::uint32_t magic, std::uint16_t major, std::uint16_t minor) {
    put(bytes, format::header::magic_at, magic);
    put(bytes, format::header::version_major_at, major | std::uint32_t{minor} << 16);
    put(bytes, format::header::total_bytes_at, static_cast<std::uint32_t>(bytes.size()));
    tests::repair_checksum(bytes);
}

/// Calls `judge(bytes, arguments)` with the input as it is, and again if `repair(bytes)` changes it. The bytes lie in a
/// copy of their exact size, at an address that the input chooses.
template <class Judge, class Repair>
void judge_repaired_too(std::span<const std::byte> input, Judge judge, Repair repair) {
    const std::size_t size = stated_size(input);
    const auto arguments = input.subspan(size);
    tests::ExactBuffer buffer(input.first(size), input.size() % 16);
    const std::span<std::byte> bytes = buffer.bytes();
    judge(bytes, arguments);
    if (size < header_bytes) return;
    repair(bytes);
    if (!std::equal(bytes.begin(), bytes.end(), input.begin())) judge(bytes, arguments);
}

/// Returns a word that a mutation makes of another one: one more, one less, a bit or the low byte changed, or a number
/// that breaks careless code.
inline std::uint32_t changed_word(std::uint32_t word, tests::Random& random) {
    constexpr std::uint32_t hostile[] = {0,          1,          2,          0xFF,       0x100,      0xFFFF,
                                         0x10000,    0xFFFFFF,   0x1000000,  0x7FFFFFFF, 0x80000000, 0x80000001,
                                         0xFFFFFFFE, 0xFFFFFFFF, 0x7F7FFFFF, 0x7F800000, 0x7FC00000, 0x00800000,
                                         0x0D800000, 0x71800000, 0x3F800000, 0xBF800000};
    switch (random.below(4)) {
        case 0:
            return word + (random.coin() ? 1u : 0xFFFFFFFFu);
        case 1:
            return word ^ 1u << random.below(32);
        case 2:
            return (word & 0xFFFFFF00u) | random.below(256);
        default:
            return hostile[random.below(std::size(hostile))];
    }
}

}  // namespace espalier::fuzz

#if defined(ESPALIER_FUZZ)
/// Of libFuzzer: mutates bytes without regard to their format and returns their new number.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);
#endif
