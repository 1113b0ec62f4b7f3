// Boxes that are small enough to be taken for the surface in them.
#pragma once

#include <bit>
#include <cstdint>

#include <runtime/box_nodes.hpp>
#include <runtime/lattice_point.hpp>
#include <runtime/lattice_ray.hpp>
#include <runtime/ray_triangle.hpp>

namespace espalier::detail {

/// An accuracy as the largest whole number of lattice steps in it; negative when boxes shall not do.
inline std::int32_t steps_in(const BlobData& blob, float accuracy) {
    if (!(accuracy > 0.0f)) return -1;
    const float steps = scale_by_power_of_two(accuracy, -blob.step_exponent);
    return steps < static_cast<float>(bounds_limit) ? static_cast<std::int32_t>(steps) : bounds_limit;
}

/// The squared distance from the point to the farthest point of a child's box, within 5 roundings.
inline float farthest_squared(const Node& node, unsigned bits, unsigned child, const LatticePoint& point) {
    float sum = 0.0f;
    for (int k = 0; k < 3; ++k) {
        const float to_low = absolute(static_cast<float>(node.low(k, child, bits)) - point.steps[k]);
        const float to_high = absolute(static_cast<float>(node.high(k, child, bits)) - point.steps[k]);
        const float far = maximum(to_low, to_high);
        sum += far * far;
    }
    return sum;
}

/// Whether the ray passes through a child's box within its window, exactly: what lanes say depends on the machine.
inline bool passes_through(const LatticeRay& ray, const Node& node, unsigned bits, unsigned child) {
    // Where the ray enters and leaves along each axis, as fractions: numerators in units of 2^-fraction_bits steps,
    // below 2^33, over the direction's magnitude, which is not 0 and below 2^25.
    std::int64_t enter[3], leave[3], length[3];
    for (int k = 0; k < 3; ++k) {
        const std::int64_t low = (std::int64_t{node.low(k, child, bits)} << ray.fraction_bits) - ray.origin[k];
        const std::int64_t high = (std::int64_t{node.high(k, child, bits)} << ray.fraction_bits) - ray.origin[k];
        const bool is_down = ray.direction[k] < 0;
        length[k] = is_down ? -std::int64_t{ray.direction[k]} : std::int64_t{ray.direction[k]};
        if (length[k] == 0 && (low > 0 || high < 0)) return false;
        enter[k] = is_down ? -high : low;
        leave[k] = is_down ? -low : high;
    }
    const auto is_within_window = [&](int k) {
        const Int128 denominator = Int128(length[k]) << ray.fraction_bits;
        if (leave[k] < 0 ||
            (ray.tau_min > 0.0f && ray_triangle::compare_quotient(Int128(leave[k]), denominator, ray.tau_min) < 0))
            return false;
        if (enter[k] <= 0 || ray.tau_max == infinity) return true;
        return ray.tau_max > 0.0f && ray_triangle::compare_quotient(Int128(enter[k]), denominator, ray.tau_max) <= 0;
    };
    for (int k = 0; k < 3; ++k) {
        if (length[k] == 0) continue;
        if (!is_within_window(k)) return false;
        for (int j = 0; j < 3; ++j)
            if (length[j] != 0 && enter[k] * length[j] > leave[j] * length[k]) return false;
    }
    return true;
}

}  // namespace espalier::detail
