// From the common grid of two blobs back to the space of the first one, and lengths to the world.
#pragma once

#include <espalier/types.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/lattice/to_local.hpp>
#include <runtime/pairs/frame.hpp>
#include <runtime/transforms/rotation.hpp>

namespace espalier::detail {

/// Returns a place of the grid in a's space.
inline Vec3 point_in_units(const PairFrame& frame, const Vec3& place) {
    return to_local(*frame.a, scale_by_power_of_two(place.x, frame.shift), scale_by_power_of_two(place.y, frame.shift),
                    scale_by_power_of_two(place.z, frame.shift));
}

/// Converts a distance of the world into a's units, or back. One that is not zero does not become zero.
inline float converted(float distance, float scale, bool into_world) {
    if (scale == 1.0f || magnitude_bits(distance) == 0) return distance;
    const float result = into_world ? distance * scale : distance / scale;
    return result >= least_coordinate ? result : least_coordinate;
}

/// Returns a length in steps of the grid in the world, where a has that scale.
inline float length_in_world(const PairFrame& frame, float steps, float scale) {
    return converted(scale_by_power_of_two(steps, frame.shift + frame.a->step_exponent), scale, true);
}

}  // namespace espalier::detail
