// Where 0 0 0 of a blob or a scene lies in its source: three float64 numbers, read by their bits, since small cores
// have no arithmetic for them.
#pragma once

#include <array>

#include <runtime/base/bits.hpp>

namespace espalier::detail {

inline bool is_source_origin(const std::byte* bytes) {
    for (std::size_t k = 0; k < 3; ++k)
        if ((load_u32(bytes + 8 * k + 4) >> 20 & 0x7FF) == 0x7FF) return false;  // not finite
    return true;
}

inline Vec3d load_source_origin(const std::byte* bytes) {
    std::array<std::uint64_t, 3> coordinates;
    for (std::size_t k = 0; k < 3; ++k)
        coordinates[k] = std::uint64_t{load_u32(bytes + 8 * k + 4)} << 32 | load_u32(bytes + 8 * k);
    return std::bit_cast<Vec3d>(coordinates);
}

}  // namespace espalier::detail
