// The rounding of positions to lattice coordinates along one axis.
#pragma once

#include <bit>
#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/base/bits.hpp>

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

    PoseAxis() = default;
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

}  // namespace espalier::detail
