// How 8 fields of one width, packed low bits first, are spread over 8 lanes of 32 bits by a byte shuffle and a shift.
#pragma once

#include <array>
#include <cstdint>

namespace espalier::detail {

/// The first 4 fields are found from the stream's byte 0 of a group, the last 4 from byte width / 2; each half's
/// shuffle counts from there.
struct UnpackEntry {
    std::uint8_t shuffle[32];
    std::uint32_t shift[8];
    std::uint32_t mask[8];
};

inline constexpr unsigned max_unpack_width = 24;

inline constexpr std::array<UnpackEntry, max_unpack_width + 1> unpack_table = [] {
    std::array<UnpackEntry, max_unpack_width + 1> table{};
    for (unsigned width = 0; width <= max_unpack_width; ++width) {
        UnpackEntry& entry = table[width];
        for (unsigned lane = 0; lane < 8; ++lane) {
            const unsigned first_byte = lane < 4 ? 0 : width / 2;
            const unsigned bit = lane * width - 8 * first_byte;
            for (unsigned byte = 0; byte < 4; ++byte) {
                const unsigned from = bit / 8 + byte;
                entry.shuffle[4 * lane + byte] = static_cast<std::uint8_t>(from < 16 ? from : 0x80);
            }
            entry.shift[lane] = bit % 8;
            entry.mask[lane] = (1u << width) - 1u;
        }
    }
    return table;
}();

/// For instruction sets without shifts by different counts: what multiplies each spread field so that it begins at this
/// bit.
inline constexpr unsigned unpack_raised_bits = 7;

inline constexpr std::array<std::array<std::uint32_t, 8>, max_unpack_width + 1> unpack_raise_table = [] {
    std::array<std::array<std::uint32_t, 8>, max_unpack_width + 1> table{};
    for (unsigned width = 0; width <= max_unpack_width; ++width)
        for (unsigned lane = 0; lane < 8; ++lane)
            table[width][lane] = 1u << (unpack_raised_bits - unpack_table[width].shift[lane]);
    return table;
}();

}  // namespace espalier::detail
