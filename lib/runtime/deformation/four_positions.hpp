// Four positions at a time, on near axes. The compiler's vector types become the machine's own instructions. The bits
// are those of PoseAxis::coordinate().
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include <espalier/types.hpp>
#include <runtime/base/options.hpp>
#include <runtime/base/vector.hpp>
#include <runtime/deformation/pose_axis.hpp>

namespace espalier::detail {

/// Rows of a leaf are little-endian numbers, which a little-endian machine stores four at a time.
inline constexpr bool takes_four_positions = !small_code && std::endian::native == std::endian::little;

using FourFloats = Vector<float, 4>;
using FourWords = Vector<std::uint32_t, 4>;

/// Four positions, axis by axis.
struct FourPositions {
    FourFloats axis[3];

    /// Loads positions, two numbers at a time where that takes fewer instructions.
    ESPALIER_ALWAYS_INLINE FourPositions(const Vec3* a, const Vec3* b, const Vec3* c, const Vec3* d) {
        using TwoPairs = Vector<std::uint64_t, 2>;
        const auto pair = [](const Vec3* position) {
            std::uint64_t x_and_y;
            ESPALIER_COPY_BYTES(&x_and_y, position, sizeof x_and_y);
            return x_and_y;
        };
        const auto first = std::bit_cast<FourFloats>(TwoPairs{pair(a), pair(b)});
        const auto second = std::bit_cast<FourFloats>(TwoPairs{pair(c), pair(d)});
        axis[0] = FourFloats{first[0], first[2], second[0], second[2]};
        axis[1] = FourFloats{first[1], first[3], second[1], second[3]};
        axis[2] = FourFloats{a->z, b->z, c->z, d->z};
    }
};

/// Returns the sums of PoseAxis::coordinate(): in the order of the coordinates, and as many apart in their bits.
ESPALIER_ALWAYS_INLINE inline FourFloats four_sums(const PoseAxis& axis, FourFloats positions) {
    return positions * axis.steps_per_unit + PoseAxis::shifter;
}

/// Writes the low 16 bits of four numbers to one place, and of four others to another.
ESPALIER_ALWAYS_INLINE inline void store_low_words(std::byte* to_a, FourWords a, std::byte* to_b, FourWords b) {
#if defined(__SSE2__)
    using EightShorts = Vector<std::int16_t, 8>;
    using FourSigned = Vector<std::int32_t, 4>;
    using TwoPairs = Vector<std::uint64_t, 2>;
    // The instruction saturates, so the high bits become copies of bit 15.
    const EightShorts words =
        ESPALIER_PACK_SATURATED(std::bit_cast<FourSigned>(a << 16) >> 16, std::bit_cast<FourSigned>(b << 16) >> 16);
    const auto pairs = std::bit_cast<TwoPairs>(words);
    const std::uint64_t of_a = pairs[0], of_b = pairs[1];
#else
    using FourShorts = Vector<std::uint16_t, 4>;
    const auto of_a = ESPALIER_CONVERT_VECTOR(a & 0xFFFF, FourShorts);
    const auto of_b = ESPALIER_CONVERT_VECTOR(b & 0xFFFF, FourShorts);
#endif
    ESPALIER_COPY_BYTES(to_a, &of_a, sizeof of_a);
    ESPALIER_COPY_BYTES(to_b, &of_b, sizeof of_b);
}

/// Tests whether four positions in a row are in range.
ESPALIER_ALWAYS_INLINE inline bool are_four_in_range(const PoseAxes& axes, const Vec3* positions) {
    static_assert(sizeof(Vec3) == 12);
    FourWords outside = {};
    for (unsigned row = 0; row < 3; ++row) {
        // Four positions are twelve numbers in a row, of which number i is on axis i modulo 3.
        const PoseAxis &a = axes.axis[row], &b = axes.axis[(row + 1) % 3], &c = axes.axis[(row + 2) % 3];
        FourFloats numbers;
        ESPALIER_COPY_BYTES(&numbers, reinterpret_cast<const std::byte*>(positions) + 16 * row, sizeof numbers);
        const FourWords zero = {a.zero_bits, b.zero_bits, c.zero_bits, a.zero_bits};
        const FourWords extent = {a.extent, b.extent, c.extent, a.extent};
        const FourWords coordinates = std::bit_cast<FourWords>(numbers * a.steps_per_unit + PoseAxis::shifter) - zero;
        // Above the extent, the coordinate or its difference has the highest bit.
        outside |= coordinates | (extent - coordinates);
    }
    return ((outside[0] | outside[1]) | (outside[2] | outside[3])) >> 31 == 0;
}

}  // namespace espalier::detail
