// A moving shape in lattice units, rounded there, once: the sweep that everything else answers exactly.
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/kernels/moving_shapes.hpp>
#include <runtime/kernels/segment_triangle.hpp>
#include <runtime/lanes/prepared_ray.hpp>

namespace espalier::detail {

/// Nothing of a sweep may be as far from the asset or as large, in lattice steps.
inline constexpr float sweep_reach = 0x1p34f;
/// Along each axis, in units of the sweep.
inline constexpr std::int64_t longest_capsule_axis = std::int64_t{1} << 25;

/// What all shapes share: the box around the shape. Units are 2^-fraction_bits lattice steps, counted from lattice
/// point 0 0 0.
struct LatticeSweep : MovingBox {
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

/// Also of a sphere: a capsule whose axis has no length.
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

/// Two points and a length in units of a sweep.
struct RoundedEnds {
    Integer3 from;
    Integer3 to;
    std::int64_t radius;
};
/// Rounds them and the displacement to one grid. Where the status is not ok, nothing is written.
inline QueryStatus round_ends(const BlobData& blob, const Capsule& world, const Vec3& displacement, LatticeSweep& sweep,
                              RoundedEnds& ends) {
    if (!is_finite(world.from) || !is_finite(world.to) || !is_finite(displacement) || !is_finite(world.radius) ||
        !is_radius(world.radius))
        return QueryStatus::invalid_argument;
    float from[3], to[3], way[3];
    Rounder rounder(blob);
    rounder.add_point(world.from, from);
    rounder.add_point(world.to, to);
    rounder.add_vector(displacement, way);
    const float radius = rounder.add_length(world.radius);
    if (!(rounder.reach() < sweep_reach)) return QueryStatus::out_of_range;
    const int bits = fraction_bits_for(rounder.reach(), point_grid);
    sweep.fraction_bits = bits;
    sweep.displacement = to_grid(way, bits);
    ends = {to_grid(from, bits), to_grid(to, bits), to_grid(radius, bits)};
    return QueryStatus::ok;
}

// Where the status is not ok, the sweep is not usable. These are out of line, so that their variables are not on the
// stack during the walk.

[[gnu::noinline]] inline QueryStatus round_sweep(const BlobData& blob, const Capsule& world, const Vec3& displacement,
                                                 CapsuleSweep& sweep) {
    RoundedEnds ends;
    const QueryStatus status = round_ends(blob, world, displacement, sweep, ends);
    if (status != QueryStatus::ok) return status;
    const auto& [from, to, radius] = ends;
    sweep.from = from;
    sweep.moving = {{sweep.displacement, radius}, to - from};
    const Integer3& axis = sweep.moving.axis;
    for (const std::int64_t along : {axis.x, axis.y, axis.z})
        if (magnitude(along) > longest_capsule_axis) return QueryStatus::out_of_range;
    const Integer3 around = {radius, radius, radius};
    sweep.low = smaller(from, to) - around;
    sweep.high = larger(from, to) + around;
    return QueryStatus::ok;
}

inline QueryStatus round_sweep(const BlobData& blob, const Sphere& world, const Vec3& displacement,
                               CapsuleSweep& sweep) {
    return round_sweep(blob, Capsule{world.center, world.center, world.radius}, displacement, sweep);
}

[[gnu::noinline]] inline QueryStatus round_sweep(const BlobData& blob, const Box& world, const Vec3& displacement,
                                                 BoxSweep& sweep) {
    RoundedEnds ends;
    const QueryStatus status = round_ends(blob, {world.min, world.max, 0.0f}, displacement, sweep, ends);
    if (status != QueryStatus::ok) return status;
    sweep.low = ends.from;
    sweep.high = ends.to;
    return QueryStatus::ok;
}

/// The box around the shape as a ray, t running from 0 to 1: a plane is met when that side of the shape meets it which
/// is ahead, and left when the other one does. Like spread_ray; the sides round once more.
template <class Lanes>
inline Lanes spread_sweep(const BlobData& blob, const LatticeSweep& sweep) {
    const float step = power_of_two(-sweep.fraction_bits);
    float lows[3], highs[3], ways[3];
    float reach = 0.0f;
    for (unsigned k = 0; k < 3; ++k) {
        lows[k] = to_float(sweep.low[k]) * step;
        highs[k] = to_float(sweep.high[k]) * step;
        ways[k] = to_float(sweep.displacement[k]) * step;
        reach = maximum(maximum(absolute(lows[k]), absolute(highs[k])), reach);
        reach = maximum(maximum(absolute(blob.extent_steps[k] - lows[k]), absolute(blob.extent_steps[k] - highs[k])),
                        reach);
    }
    const float slack_steps = slab_slack(reach) + Lanes::box_slack(blob);
    Lanes lanes{};
    unsigned signs = 0;
    for (unsigned k = 0; k < 3; ++k) {
        const bool runs_down = ways[k] < 0.0f;
        const float inverse = 1.0f / lattice_ray::or_if_zero(ways[k], 1.0f / still);
        lanes.set_inverse(blob, k, inverse);
        const float slack = absolute(inverse) * slack_steps;
        lanes.near_offset[k] = -(runs_down ? lows[k] : highs[k]) * inverse - lanes.low(k) - slack;
        lanes.far_offset[k] = -(runs_down ? highs[k] : lows[k]) * inverse - lanes.low(k) + slack;
        signs |= (runs_down ? 1u : 0u) << k;
    }
    lanes.tau_min = 0.0f;
    lanes.planes = Lanes::plane_orders()[signs];
    return lanes;
}

}  // namespace espalier::detail
