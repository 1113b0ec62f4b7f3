// What the vocabularies of all instruction sets include, and the tables by which they decode leaves. Parts of a
// vocabulary (.inl) are pasted into the namespace of the set.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <runtime/base/bits.hpp>
#include <runtime/base/vector.hpp>
#include <runtime/blob/duplicate_references.hpp>
#include <runtime/blob/plain_leaf.hpp>
#include <runtime/blob/strip_leaf.hpp>
#include <runtime/blob/vertex_word.hpp>
#include <runtime/lanes/prepared_ray.hpp>
#include <espalier/base/compiler.hpp>

namespace espalier::detail {

/// How 8 fields of one width, packed low bits first, are spread over 8 lanes of 32 bits by a byte shuffle and a shift.
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

/// The pivots of 8 windows from the marks of the 8 entries that they begin with, as a byte shuffle: the last marked one
/// that is not behind the window; byte 8 stands for the pivot from before.
inline constexpr std::array<std::array<std::uint8_t, 8>, 256> pivot_table = [] {
    std::array<std::array<std::uint8_t, 8>, 256> table{};
    for (unsigned marks = 0; marks < 256; ++marks) {
        std::uint8_t pivot = 8;
        for (unsigned window = 0; window < 8; ++window) {
            if ((marks >> window & 1u) != 0) pivot = static_cast<std::uint8_t>(window);
            table[marks][window] = pivot;
        }
    }
    return table;
}();

}  // namespace espalier::detail
