// What was found nearest, in the caller's units.
#pragma once

#include <espalier/nearest.hpp>
#include <runtime/lattice_world.hpp>
#include <runtime/found.hpp>
#include <runtime/square_root.hpp>

namespace espalier::detail {

/// The root of a squared distance in lattice steps, and `offset` of them more. That it is within max_distance was
/// decided exactly: rounding must not say otherwise.
ESPALIER_SHARED_CODE inline float to_world_distance(const BlobData& blob, float squared, float offset,
                                                    float max_distance) {
    const float distance = scale_by_power_of_two(square_root(squared) + offset, blob.step_exponent);
    return magnitude_bits(distance) > magnitude_bits(max_distance) ? max_distance : distance;
}

/// Everything but the distance, which is still squared and in lattice steps.
ESPALIER_SHARED_CODE inline Nearest to_nearest(const BlobData& blob, const FoundNearest& found) {
    const PointDistance& distance = found.distance;
    float point[3];
    point_of(found.triangle, distance.u, distance.v, point);
    return {to_world(blob, point[0], point[1], point[2]),
            distance.squared,
            distance.u,
            distance.v,
            Triangle{found.index},
            distance.feature};
}

}  // namespace espalier::detail
