// The rounding of positions to lattice coordinates, axis by axis: one position at a time, or four.
#pragma once

#include <espalier/blob.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/base/vector.hpp>

namespace espalier::detail {

/// One axis of a lattice. A coordinate is the nearest multiple of the step, ties to the even one, counted from the
/// origin.
///
/// On a near axis all coordinates are less than 2^22 steps from 0. There, adding 3 * 2^22 rounds a number of steps, and
/// leaves the sum of it and a constant in the low bits. Of other numbers the result is above the extent, since floats
/// of one sign are ordered as their bits are.
struct PoseAxis {
    static constexpr float shifter = 0x1.8p23f;
    static constexpr float nearness = 0x1p22f;

    float steps_per_unit;
    float origin_steps;  ///< whole
    float extent_steps;
    std::uint32_t extent;
    std::uint32_t zero_bits;  ///< of the sum for coordinate 0, on a near axis

    PoseAxis(const BlobData& blob, int axis)
        : steps_per_unit(blob.steps_per_unit),
          origin_steps(blob.origin[axis] * blob.steps_per_unit),
          extent_steps(blob.extent_steps[axis]),
          extent(static_cast<std::uint32_t>(blob.extent[axis])),
          zero_bits(std::bit_cast<std::uint32_t>(shifter + origin_steps)) {}

    [[nodiscard]] bool is_near() const { return origin_steps > -nearness && origin_steps + extent_steps < nearness; }

    /// Returns the coordinate, or a number above the extent if the position is NaN, infinite or out of range.
    template <bool near>
    [[nodiscard]] std::uint32_t coordinate(float position) const {
        const float steps = position * steps_per_unit;
        if constexpr (near) return std::bit_cast<std::uint32_t>(steps + shifter) - zero_bits;
        // Exact where the coordinate is in range: a whole number below 2^24. Others stay outside when they are rounded.
        const float from_origin = round_to_integer(steps) - origin_steps;
        const bool is_inside = from_origin >= 0.0f && from_origin <= extent_steps;
        return is_inside ? static_cast<std::uint32_t>(static_cast<std::int32_t>(from_origin)) : ~std::uint32_t{0};
    }
};

/// The axes of a lattice.
struct PoseAxes {
    PoseAxis axis[3];
    bool are_near;

    explicit PoseAxes(const BlobData& blob)
        : axis{PoseAxis(blob, 0), PoseAxis(blob, 1), PoseAxis(blob, 2)},
          are_near(axis[0].is_near() && axis[1].is_near() && axis[2].is_near()) {}
};

// Four positions at a time, on near axes. The compiler's vector types become the machine's own instructions. The bits
// are those of PoseAxis::coordinate().

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
