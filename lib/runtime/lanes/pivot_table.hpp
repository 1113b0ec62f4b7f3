// The pivots of 8 windows from the marks of the 8 entries that they begin with, as a byte shuffle: the last marked one
// that is not behind the window; byte 8 stands for the pivot from before.
#pragma once

#include <array>
#include <cstdint>

namespace espalier::detail {

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
