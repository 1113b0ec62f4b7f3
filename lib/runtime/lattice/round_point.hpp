// A point and a radius moved into lattice units and rounded there, once: the query that everything else answers
// exactly.
#pragma once

#include <runtime/lattice/rounder.hpp>

namespace espalier::detail {

/// Squared distances of boxes are compared with this much slack, 64 roundings: it covers those of both sides.
inline constexpr float distance_slack = 1.0f + 0x1p-18f;

struct RoundedPoint {
    std::int64_t origin[3];  ///< the point, in units of 2^-fraction_bits lattice steps; below 2^37 steps
    int fraction_bits;       ///< 0..6
    alignas(register_alignment) float steps[4];  ///< the same in float, exactly; the fourth is zero
    float radius;                                ///< lattice steps; may be infinite
    float limit;                                 ///< squared radius with slack: boxes farther away hold nothing
    float inner_limit;                           ///< squared radius less the slack: what is all nearer overlaps
    float distance_offset;  ///< lattice steps: how far a point from far away was moved towards the asset
};

/// Rounds a point and a radius. Returns not_found if nothing can be within the radius, invalid_argument or out_of_range
/// for arguments outside of the domain; the point is not usable then.
ESPALIER_SHARED_CODE inline QueryStatus round_point(const BlobData& blob, const Vec3& local, float radius,
                                                    RoundedPoint& point) {
    if (!is_radius(radius) || !is_finite(local)) return QueryStatus::invalid_argument;
    float center[3];
    Rounder rounder(blob);
    rounder.add_point(local, center);
    float reach = rounder.reach();
    if (!(reach < 0x1p120f)) return QueryStatus::out_of_range;
    float gap[3];  // from the asset's box
    float farthest = 0.0f;
    for (int k = 0; k < 3; ++k) {
        const float high = blob.extent_steps[k];
        // mutant(< -> <=, > -> >=) equivalent: both sides are equal then
        gap[k] = center[k] < 0.0f ? center[k] : center[k] > high ? center[k] - high : 0.0f;
        farthest = maximum(absolute(gap[k]), farthest);
    }
    float radius_steps = radius_in_steps(blob, radius);

    point.distance_offset = 0.0f;
    if (farthest >= 0x1p36f) {
        // From this far all of the asset lies in one direction, nearly enough that a shorter gap in that direction
        // orders its points alike to within half a unit in the last place of their distances.
        const int shrink = exponent_of(farthest) - 35;
        float squared = 0.0f;
        for (int k = 0; k < 3; ++k) {
            const float near = gap[k] * power_of_two(-shrink);
            center[k] = (center[k] - gap[k]) + near;
            squared += near * near;
        }
        const float near_distance = square_root(squared);
        const float distance = scale_by_power_of_two(near_distance, shrink);
        point.distance_offset = distance - near_distance;
        radius_steps -= point.distance_offset;
        if (radius_steps < 0.0f) return QueryStatus::not_found;
        reach = 0x1p37f;
    }
    point.fraction_bits = fraction_bits_for(reach, point_grid);
    to_grid(center, point.fraction_bits, point.origin, point.steps);
    point.radius = radius_steps;
    point.limit = radius_steps * radius_steps * distance_slack;
    point.inner_limit = radius_steps * radius_steps * (2.0f - distance_slack);
    return QueryStatus::ok;
}

/// Rounds the point of a query for what is nearest. Returns ok, not_found if nothing can be near, or why the query is
/// refused.
inline QueryStatus round_query(const BlobData& blob, const Vec3& local, float max_distance, RoundedPoint& point) {
    if (blob.bytes == nullptr) return QueryStatus::not_open;
    const QueryStatus status = round_point(blob, local, max_distance, point);
    return status == QueryStatus::ok && blob.triangle_count == 0 ? QueryStatus::not_found : status;
}

}  // namespace espalier::detail
