// Approximate queries: they take less work and may err by as much as you allow, on the safe side.
//
// The accuracy is a length in the blob's units. A walk that reaches a box of the tree whose largest side is at most
// that takes the box for the surface in it and goes no deeper; every box holds some of the surface. This saves most
// where the accuracy is coarser than the triangles: for what is far away, for sound, for planning.
//
// Nothing is missed: where the exact query returns a hit or a yes, these do. An accuracy of 0, below 0 or NaN gives the
// exact answer. One far below the size of a leaf costs time and gains nothing, since leaves are not split further.
//
// Arguments and refusals are those of the exact queries in overlap.hpp, ray.hpp and distance.hpp. Thread safety: any
// number of threads may query one blob, each with counters of its own. No call allocates. Numerics are described at the
// end of this file.
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

/// Returns whether the surface may overlap the shape: no is certain, yes may be off by about the accuracy.
///
/// Refuses the shapes that the exact query refuses. Adds its work to `counters` if that is not null.
template <class Shape>
requires(std::same_as<Shape, Sphere> || std::same_as<Shape, Box>) [[nodiscard]] YesNo
    overlaps(const Blob& blob, const Shape& shape, Accuracy accuracy, QueryCounters* counters = nullptr) noexcept {
    return detail::overlaps(blob, detail::AnyShape(shape), accuracy, counters);
}

/// Returns whether the ray may hit the surface: no is certain, yes may be off by about the accuracy. Where the walk
/// stops at a box, Ray::culling has no effect.
///
/// Refuses the rays that raycast() refuses. Adds its work to `counters` if that is not null.
YesNo occluded(const Blob& blob, const Ray& ray, Accuracy accuracy, QueryCounters* counters = nullptr) noexcept;

/// Bounds of a distance: it is at least `lower` and at most `upper`. The default holds for any distance.
struct DistanceBounds {
    float lower = 0.0f;
    float upper = infinity;
};

/// Returns a lower and an upper bound of the distance from the point to the surface. Where `upper` is above
/// max_distance, the surface may or may not be within it.
///
/// Status: ok; not_found if nothing is within max_distance; or not_open, invalid_argument or out_of_range, as
/// closest_point() refuses. Adds its work to `counters` if that is not null.
Result<DistanceBounds> distance_bounds(const Blob& blob, Vec3 point, float max_distance, Accuracy accuracy,
                                       QueryCounters* counters = nullptr) noexcept;

}  // namespace espalier

// Numerics. A yes that the exact query does not give implies that the surface comes within accuracy * sqrt(3) of the
// ray or shape as rounded, for a Sphere 2^-18 of its radius more; within accuracy along every axis of a Box. Boxes of
// the tree end at whole lattice steps. The bounds of a distance differ by at most accuracy * sqrt(3) and 2^-16 of the
// distance. Every machine returns the same bits.
