// A moving shape in lattice units, rounded there, once: the sweep that everything else answers exactly.
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <runtime/base/float_bits.hpp>
#include <runtime/kernels/moving_box.hpp>
#include <runtime/kernels/moving_capsule.hpp>
#include <runtime/kernels/segment_triangle.hpp>
#include <runtime/lanes/prepared_ray.hpp>

namespace espalier::detail {

/// Nothing of a sweep may be as far from the asset or as large, in lattice steps.
inline constexpr float sweep_reach = 0x1p34f;
/// Along each axis, in units of the sweep.
inline constexpr std::int64_t longest_capsule_axis = std::int64_t{1} << 25;

/// What all shapes share. Units are 2^-fraction_bits lattice steps, counted from lattice point 0 0 0.
struct LatticeSweep {
    Integer3 low;  ///< of the box around the shape at the start
    Integer3 high;
    Integer3 displacement;
    int fraction_bits;  ///< 0..6

    /// Returns the triangle in units, relative to the point.
    [[nodiscard]] IntegerTriangle seen_from(const Integer3& point, const LatticeTriangle& triangle) const {
        IntegerTriangle result;
        for (int i = 0; i < 3; ++i) result.corner[i] = corner_on_grid(triangle, i, fraction_bits) - point;
        return result;
    }
    [[nodiscard]] Integer3 middle() const {
        return {(low.x + high.x) >> 1, (low.y + high.y) >> 1, (low.z + high.z) >> 1};
    }
};

struct SphereSweep : LatticeSweep {
    Integer3 center;
    std::int64_t radius;
};
struct CapsuleSweep : LatticeSweep {
    Integer3 from;
    MovingCapsule moving;
};
struct BoxSweep : LatticeSweep {};

/// Whether the boxes around shape and triangle meet at the start. Out of line, so as not to lie on the stack below a
/// kernel.
[[gnu::noinline]] inline bool boxes_meet_at_start(const LatticeSweep& sweep, const LatticeTriangle& triangle) {
    for (int k = 0; k < 3; ++k) {
        const auto [low, high] = span_of(triangle, k);
        if (sweep.high[k] < std::int64_t{low} << sweep.fraction_bits ||
            std::int64_t{high} << sweep.fraction_bits < sweep.low[k])
            return false;
    }
    return true;
}

/// Whether the shape touches the triangle at the start.
inline bool touches_at_start(const CapsuleSweep& sweep, const LatticeTriangle& triangle) {
    if (!boxes_meet_at_start(sweep, triangle)) return false;
    const UnitSegment axis = {sweep.from, sweep.from + sweep.moving.axis, sweep.fraction_bits};
    // The radius came from a float and is one still.
    const float radius = to_float(sweep.moving.sphere.radius) * power_of_two(-sweep.fraction_bits);
    return is_within_radius(axis, triangle, distance_to(axis, triangle), radius);
}

inline bool is_length(float length) { return is_finite(length) && is_radius(length); }

// Where the status is not ok, the sweep is not written. These are out of line, so that their variables are not on the
// stack during the walk.

[[gnu::noinline]] inline QueryStatus round_sweep(const BlobData& blob, const Sphere& world, const Vec3& displacement,
                                                 SphereSweep& sweep) {
    if (!is_finite(world.center) || !is_finite(displacement) || !is_length(world.radius))
        return QueryStatus::invalid_argument;
    float center[3], way[3];
    Rounder rounder(blob);
    rounder.add_point(world.center, center);
    rounder.add_vector(displacement, way);
    const float radius = rounder.add_length(world.radius);
    if (!(rounder.reach() < sweep_reach)) return QueryStatus::out_of_range;
    sweep.fraction_bits = fraction_bits_for(rounder.reach(), point_grid);
    sweep.displacement = to_grid(way, sweep.fraction_bits);
    sweep.center = to_grid(center, sweep.fraction_bits);
    sweep.radius = to_grid(radius, sweep.fraction_bits);
    const Integer3 half = {sweep.radius, sweep.radius, sweep.radius};
    sweep.low = sweep.center - half;
    sweep.high = sweep.center + half;
    return QueryStatus::ok;
}

[[gnu::noinline]] inline QueryStatus round_sweep(const BlobData& blob, const Capsule& world, const Vec3& displacement,
                                                 CapsuleSweep& sweep) {
    if (!is_finite(world.from) || !is_finite(world.to) || !is_finite(displacement) || !is_length(world.radius))
        return QueryStatus::invalid_argument;
    float from[3], to[3], way[3];
    Rounder rounder(blob);
    rounder.add_point(world.from, from);
    rounder.add_point(world.to, to);
    rounder.add_vector(displacement, way);
    const float radius = rounder.add_length(world.radius);
    if (!(rounder.reach() < sweep_reach)) return QueryStatus::out_of_range;
    sweep.fraction_bits = fraction_bits_for(rounder.reach(), point_grid);
    sweep.displacement = to_grid(way, sweep.fraction_bits);
    const std::int64_t units = to_grid(radius, sweep.fraction_bits);
    sweep.from = to_grid(from, sweep.fraction_bits);
    const Integer3 end = to_grid(to, sweep.fraction_bits);
    sweep.moving = {{sweep.displacement, units}, end - sweep.from};
    const Integer3& axis = sweep.moving.axis;
    for (const std::int64_t along : {axis.x, axis.y, axis.z})
        if (along > longest_capsule_axis || along < -longest_capsule_axis) return QueryStatus::out_of_range;
    const Integer3 around = {units, units, units};
    sweep.low = smaller(sweep.from, end) - around;
    sweep.high = larger(sweep.from, end) + around;
    return QueryStatus::ok;
}

[[gnu::noinline]] inline QueryStatus round_sweep(const BlobData& blob, const Box& world, const Vec3& displacement,
                                                 BoxSweep& sweep) {
    if (!is_finite(world.min) || !is_finite(world.max) || !is_finite(displacement))
        return QueryStatus::invalid_argument;
    float low[3], high[3], way[3];
    Rounder rounder(blob);
    rounder.add_point(world.min, low);
    rounder.add_point(world.max, high);
    rounder.add_vector(displacement, way);
    if (!(rounder.reach() < sweep_reach)) return QueryStatus::out_of_range;
    sweep.fraction_bits = fraction_bits_for(rounder.reach(), point_grid);
    sweep.displacement = to_grid(way, sweep.fraction_bits);
    sweep.low = to_grid(low, sweep.fraction_bits);
    sweep.high = to_grid(high, sweep.fraction_bits);
    return QueryStatus::ok;
}

/// The box around the shape as a ray, t running from 0 to 1: a plane is met when that side of the shape meets it which
/// is ahead, and left when the other one does. Like spread_ray; the sides round once more.
template <class Lanes>
inline Lanes spread_sweep(const BlobData& blob, const LatticeSweep& sweep) {
    const float step = power_of_two(-sweep.fraction_bits);
    const Integer3 &low = sweep.low, &high = sweep.high, &way = sweep.displacement;
    const float lows[3] = {to_float(low.x) * step, to_float(low.y) * step, to_float(low.z) * step};
    const float highs[3] = {to_float(high.x) * step, to_float(high.y) * step, to_float(high.z) * step};
    const float ways[3] = {to_float(way.x) * step, to_float(way.y) * step, to_float(way.z) * step};
    float reach = 0.0f;
    for (unsigned k = 0; k < 3; ++k) {
        reach = maximum(maximum(absolute(lows[k]), absolute(highs[k])), reach);
        reach = maximum(maximum(absolute(blob.extent_steps[k] - lows[k]), absolute(blob.extent_steps[k] - highs[k])),
                        reach);
    }
    const float slack_steps = slab_slack(reach) + Lanes::box_slack(blob);
    Lanes lanes{};
    unsigned signs = 0;
    for (unsigned k = 0; k < 3; ++k) {
        const bool runs_down = ways[k] < 0.0f;
        lanes.set_inverse(blob, k, 1.0f / lattice_ray::or_if_zero(ways[k], 1.0f / still));
        const float slack = absolute(lanes.inverse[k]) * slack_steps;
        lanes.near_offset[k] = -(runs_down ? lows[k] : highs[k]) * lanes.inverse[k] - slack;
        lanes.far_offset[k] = -(runs_down ? highs[k] : lows[k]) * lanes.inverse[k] + slack;
        signs |= (runs_down ? 1u : 0u) << k;
    }
    lanes.tau_min = 0.0f;
    lanes.planes = Lanes::plane_orders()[signs];
    return lanes;
}

}  // namespace espalier::detail
