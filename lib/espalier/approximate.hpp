// Approximate queries: they take less work and may err, always on the safe side, by as much as you allow.
//
// The accuracy is a length in the blob's units. When a traversal reaches a box of the tree whose largest side is at
// most that long, it takes the box for the surface inside and does not descend further; every box contains some of the
// surface. This saves most where the accuracy is coarser than the triangles: for distant objects, for sound, for
// planning.
//
// Nothing is missed: wherever the exact query returns a hit or a yes, the approximate one does too. With an accuracy of
// 0, below 0 or NaN the answer is exact. An accuracy far below the size of a leaf costs time and gains nothing, because
// leaves are not split further.
//
// Arguments and refusals are those of the exact queries in overlap.hpp, ray.hpp and distance.hpp. Any number of threads
// may query the same blob, each with counters of its own, and no call allocates. Numerics are described at the end of
// this file.
#pragma once

#include <concepts>

#include <espalier/blob.hpp>
#include <espalier/overlap.hpp>
#include <espalier/ray.hpp>
#include <espalier/shapes.hpp>
#include <espalier/advanced/statistics.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

namespace detail {

YesNo overlaps(const Blob& blob, AnyShape shape, Accuracy accuracy, QueryCounters* counters) noexcept;

}  // namespace detail

/// Returns whether the surface may overlap the shape. A no is certain; a yes may be wrong by about the accuracy.
///
/// Refuses the shapes that the exact query refuses. Adds its work to `counters` unless that is null.
template <class Shape>
requires(std::same_as<Shape, Sphere> || std::same_as<Shape, Box>) [[nodiscard]] YesNo
    overlaps(const Blob& blob, const Shape& shape, Accuracy accuracy, QueryCounters* counters = nullptr) noexcept {
    return detail::overlaps(blob, detail::AnyShape(shape), accuracy, counters);
}

/// Returns whether the ray may hit the surface. A no is certain; a yes may be wrong by about the accuracy. Ray::culling
/// has no effect where the traversal stops at a box.
///
/// Refuses the rays that raycast() refuses. Adds its work to `counters` unless that is null.
YesNo occluded(const Blob& blob, const Ray& ray, Accuracy accuracy, QueryCounters* counters = nullptr) noexcept;

/// A distance that is at least `lower` and at most `upper`. The default bounds hold for any distance.
struct DistanceBounds {
    float lower = 0.0f;
    float upper = infinity;
};

/// Returns a lower and an upper bound on the distance from the point to the surface. If `upper` exceeds max_distance,
/// the surface may or may not be within that distance.
///
/// The status is ok; not_found if nothing is within max_distance; or a refusal like that of closest_point(), which is
/// not_open, invalid_argument or out_of_range. Adds its work to `counters` unless that is null.
Result<DistanceBounds> distance_bounds(const Blob& blob, Vec3 point, float max_distance, Accuracy accuracy,
                                       QueryCounters* counters = nullptr) noexcept;

}  // namespace espalier

// Numerics. Where an approximate query says yes and the exact one does not, the surface comes within accuracy * sqrt(3)
// of the ray or shape as rounded, and 2^-18 of the radius more for a Sphere; for a Box, within the accuracy along every
// axis. The boxes of the tree end at whole lattice steps. The bounds of a distance differ by at most accuracy * sqrt(3)
// plus 2^-16 of the distance. Every machine returns the same bits.
