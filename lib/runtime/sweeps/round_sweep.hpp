// A moving shape in lattice units, rounded there, once: the sweep that everything else answers exactly.
#pragma once

#include <cstdint>
#include <type_traits>

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
/// The reach of oriented boxes and convex hulls, whose kernel multiplies more coordinates.
inline constexpr float hull_sweep_reach = 0x1p30f;
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

    [[nodiscard]] UnitSegment axis() const { return {from, from + moving.axis, fraction_bits}; }
};
struct BoxSweep : LatticeSweep {};
/// Also of an oriented box: the hull of its corners.
struct HullSweep : LatticeSweep {
    MovingHull moving;
    bool is_box;  ///< then corners 1, 2 and 4 are at the other ends of the edges from corner 0
};

/// What a shape is rounded to.
template <class Shape>
using SweepOf = std::conditional_t<
    std::is_same_v<Shape, Box>, BoxSweep,
    std::conditional_t<std::is_same_v<Shape, Sphere> || std::is_same_v<Shape, Capsule>, CapsuleSweep, HullSweep>>;

/// Whether the boxes around shape and triangle meet at the start. Out of line, so as not to lie on the stack below a
/// kernel.
ESPALIER_NOINLINE inline bool boxes_meet_at_start(const LatticeSweep& sweep, const LatticeTriangle& triangle) {
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
    const UnitSegment axis = sweep.axis();
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
inline QueryStatus round_ends(const BlobData& blob, const Capsule& local, const Vec3& displacement, LatticeSweep& sweep,
                              RoundedEnds& ends) {
    if (!is_finite(local.from) || !is_finite(local.to) || !is_finite(displacement) || !is_finite(local.radius) ||
        !is_radius(local.radius))
        return QueryStatus::invalid_argument;
    float from[3], to[3], way[3];
    Rounder rounder(blob);
    rounder.add_point(local.from, from);
    rounder.add_point(local.to, to);
    rounder.add_vector(displacement, way);
    const float radius = rounder.add_length(local.radius);
    if (!(rounder.reach() < sweep_reach)) return QueryStatus::out_of_range;
    const int bits = fraction_bits_for(rounder.reach(), point_grid);
    sweep.fraction_bits = bits;
    sweep.displacement = to_grid(way, bits);
    ends = {to_grid(from, bits), to_grid(to, bits), to_grid(radius, bits)};
    return QueryStatus::ok;
}

// Where the status is not ok, the sweep is not usable. These are out of line, so that their variables are not on the
// stack during the walk.

ESPALIER_NOINLINE inline QueryStatus round_sweep(const BlobData& blob, const Capsule& local, const Vec3& displacement,
                                                 CapsuleSweep& sweep) {
    RoundedEnds ends;
    const QueryStatus status = round_ends(blob, local, displacement, sweep, ends);
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

inline QueryStatus round_sweep(const BlobData& blob, const Sphere& local, const Vec3& displacement,
                               CapsuleSweep& sweep) {
    return round_sweep(blob, Capsule{local.center, local.center, local.radius}, displacement, sweep);
}

ESPALIER_NOINLINE inline QueryStatus round_sweep(const BlobData& blob, const Box& local, const Vec3& displacement,
                                                 BoxSweep& sweep) {
    RoundedEnds ends;
    const QueryStatus status = round_ends(blob, {local.min, local.max, 0.0f}, displacement, sweep, ends);
    if (status != QueryStatus::ok) return status;
    sweep.low = ends.from;
    sweep.high = ends.to;
    return QueryStatus::ok;
}

/// Sets what all hulls share, once their points are rounded.
inline void set_hull(HullSweep& sweep, const float* way, int bits) {
    sweep.fraction_bits = bits;
    sweep.displacement = to_grid(way, bits);
    sweep.moving.displacement = sweep.displacement;
    for (int k = 0; k < 3; ++k) {
        std::int32_t low = 0, high = 0;
        for (unsigned i = 0; i < sweep.moving.point_count; ++i) {
            const std::int32_t at = sweep.moving.point[i][k];
            low = i == 0 || at < low ? at : low;
            high = i == 0 || high < at ? at : high;
        }
        sweep.low[k] = low;
        sweep.high[k] = high;
    }
}

/// Rounds the vertices one by one.
ESPALIER_NOINLINE inline QueryStatus round_sweep(const BlobData& blob, const ConvexHull& local,
                                                 const Vec3& displacement, HullSweep& sweep) {
    if (local.vertices.size() > max_hull_vertices || !is_finite(displacement)) return QueryStatus::invalid_argument;
    float at[3], way[3];
    Rounder rounder(blob);
    rounder.add_vector(displacement, way);
    for (const Vec3& vertex : local.vertices) {
        if (!is_finite(vertex)) return QueryStatus::invalid_argument;
        rounder.add_point(vertex, at);
    }
    if (!(rounder.reach() < hull_sweep_reach)) return QueryStatus::out_of_range;
    const int bits = fraction_bits_for(rounder.reach(), point_grid);
    sweep.is_box = false;
    sweep.moving.point_count = 0;
    for (const Vec3& vertex : local.vertices) {
        rounder.add_point(vertex, at);
        const Integer3 point = to_grid(at, bits);
        std::int32_t* const to = sweep.moving.point[sweep.moving.point_count++];
        for (int k = 0; k < 3; ++k) to[k] = static_cast<std::int32_t>(point[k]);
    }
    set_hull(sweep, way, bits);
    return QueryStatus::ok;
}

/// Rounds the center and the half axes: the corners are exact sums of those.
ESPALIER_NOINLINE inline QueryStatus round_sweep(const BlobData& blob, const OrientedBox& local,
                                                 const Vec3& displacement, HullSweep& sweep) {
    if (!is_finite(local) || !is_finite(displacement)) return QueryStatus::invalid_argument;
    float way[3];
    Rounder rounder(blob);
    rounder.add_vector(displacement, way);
    const OrientedBoxInSteps steps(local, rounder);
    if (!(rounder.reach() < hull_sweep_reach)) return QueryStatus::out_of_range;
    const int bits = fraction_bits_for(rounder.reach(), point_grid);
    const Integer3 middle = to_grid(steps.center, bits);
    const Integer3 halves[3] = {to_grid(steps.half[0], bits), to_grid(steps.half[1], bits),
                                to_grid(steps.half[2], bits)};
    sweep.is_box = true;
    sweep.moving.point_count = 8;
    for (unsigned i = 0; i < 8; ++i) {
        Integer3 corner = middle;
        for (unsigned j = 0; j < 3; ++j) corner = (i >> j & 1u) != 0 ? corner + halves[j] : corner - halves[j];
        for (int k = 0; k < 3; ++k) sweep.moving.point[i][k] = static_cast<std::int32_t>(corner[k]);
    }
    set_hull(sweep, way, bits);
    return QueryStatus::ok;
}

/// The box around the shape as a ray, t running from 0 to 1: a plane is met when that side of the shape meets it which
/// is ahead, and left when the other one does. Like spread_ray; the sides round once more.
template <class Lanes>
inline Lanes spread_sweep(const BlobData& blob, const LatticeSweep& sweep) {
    const float step = power_of_two(-sweep.fraction_bits);
    float lows[3] = {}, highs[3] = {}, ways[3] = {};
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
