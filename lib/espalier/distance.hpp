// Distance queries: the closest point of the surface to a point, a segment or a box, the closest triangles, and for
// closed surfaces whether a point is inside.
//
// Coordinates and distances are in the asset's local space and units. Every query refuses a blob that is not open
// (QueryStatus::not_open) and a NaN, an infinite coordinate or a max_distance below 0 (invalid_argument). A
// max_distance may be infinite. Refusals cost O(1).
//
// Thread safety: any number of threads may query one blob. No call allocates. Numerics are described at the end of this
// file.
#pragma once

#include <concepts>
#include <cstdint>
#include <span>

#include <espalier/blob.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// The result of a distance query: converts to true if there is a closest point. A miss has an infinite distance and
/// no_triangle.
struct [[nodiscard]] ClosestPoint {
    Vec3 point;        ///< on the surface
    Vec3 on_shape;     ///< the point of the shape at that distance; of a point: itself, as it was given
    Vec3 face_normal;  ///< unit length, pointing away from the front of the triangle; zero for one without area
    float distance = infinity;
    float u = 0.0f;                              ///< barycentric weight of corner b
    float v = 0.0f;                              ///< barycentric weight of corner c; corner a has 1 - u - v
    TriangleId triangle;                         ///< baked order; its corners are those of triangle_at()
    QueryStatus status = QueryStatus::not_open;  ///< ok, not_found, or why the query was refused
    Feature feature = Feature::face;             ///< the smallest part of the triangle that holds the point, exactly
    Side side = Side::front;  ///< back if all of the shape lies behind the triangle's plane, exactly; else front
    std::uint8_t reserved = 0;

    explicit constexpr operator bool() const noexcept { return status == QueryStatus::ok; }
};

/// Returns the closest point of the surface within max_distance; of equally close triangles, that of the lowest index.
///
/// Refuses a point that is 2^120 lattice steps or more away (out_of_range). Cost: expected O(log n);
/// docs/queries/README.md, Bounded, has the bound.
ClosestPoint closest_point(const Blob& blob, Vec3 point, float max_distance = infinity) noexcept;

namespace detail {

ClosestPoint closest_to_segment(const Blob& blob, const Segment& segment, float max_distance) noexcept;
ClosestPoint closest_to_box(const Blob& blob, const Box& box, float max_distance) noexcept;

}  // namespace detail

/// Returns the closest pair of points, one of the segment and one of the surface. The segment may have length zero. The
/// distance is 0 exactly if they share a point, and the result is one such point.
///
/// Refuses a segment that reaches 2^36 lattice steps or more from any vertex of the asset along an axis (out_of_range).
/// Cost: as for a point, but several times as much per triangle.
///
/// The same for a solid box, of which an empty one has no closest point (not_found). A template, so that braces mean a
/// point: closest_point(blob, {x, y, z}).
template <class Shape>
requires std::same_as<Shape, Segment> || std::same_as<Shape, Box> ClosestPoint
closest_point(const Blob& blob, const Shape& shape, float max_distance = infinity)
noexcept {
    if constexpr (std::same_as<Shape, Segment>) return detail::closest_to_segment(blob, shape, max_distance);
    else return detail::closest_to_box(blob, shape, max_distance);
}

/// Writes the triangles that are closest to the point and within max_distance, as many as `nearest` has room for, each
/// with its own closest point, sorted by distance; equally close ones by index. The first is the result of
/// closest_point(). A triangle with duplicate references appears once. The rest of `nearest` is not written.
///
/// The status is ok also if more triangles are within max_distance. Refuses what closest_point() refuses.
/// Cost: O(log(nearest.size())) for each triangle that is closer than those found before; O(nearest.size()) in a blob
/// with duplicate references.
Filled closest_triangles(const Blob& blob, Vec3 point, std::span<ClosestPoint> nearest,
                         float max_distance = infinity) noexcept;

/// Returns whether the point is inside the closed surface. A point on the surface is inside; a point however far away
/// is outside.
///
/// Refuses a surface that is not closed (not_closed). Inside is where the winding number is not zero: overlapping
/// shells are inside of both, a cavity whose triangles face inward is outside, and a surface that was baked inside out
/// has the same inside. Triangles need not share their vertices: a corner may lie on another triangle's edge. Cost: the
/// triangles along the shortest way from the point out of the asset's box, parallel to an axis.
YesNo contains(const Blob& blob, Vec3 point) noexcept;

/// Returns the closest point of the surface, with a negative distance if the point is inside. If the surface is farther
/// than max_distance, the status is not_found and the distance is max_distance, negative inside.
///
/// Refuses what contains() and closest_point() refuse. Cost: that of both.
ClosestPoint signed_distance(const Blob& blob, Vec3 point, float max_distance = infinity) noexcept;

/// The largest number of directions that winding_number() takes.
inline constexpr unsigned max_winding_directions = 4096;

/// Returns approximately how often the surface, open or closed, winds around the point: the mean of the numbers that
/// rays in `directions` directions count, from 2 to max_winding_directions, an odd number as the next even one.
///
/// Where the surface is closed around the point every ray counts the same, so the value is a whole number: 1 inside, 0
/// outside, more where shells overlap, -1 inside of a surface that was baked inside out. Through a hole rays leave
/// uncounted, and the value lies between: above 0.5 is the usual meaning of inside. A point within rounding of the
/// surface has the value of either side, or one between.
///
/// Refuses a NaN or an infinity and another number of directions (invalid_argument), and points as raycast() refuses
/// origins. Cost: for_each_crossing() once for each direction.
[[nodiscard]] Result<float> winding_number(const Blob& blob, Vec3 point, unsigned directions = 64) noexcept;

}  // namespace espalier

// Numerics
//
// Rounding. A point is rounded once onto a grid finer than the asset's lattice (docs/numerics.md). A segment or a box
// is rounded as finely as its farthest coordinate allows, to 2^-6 of a lattice step at the finest. rounding.hpp returns
// bounds.
//
// Decisions. For the rounded query they are exact: `side`, the `feature` of the pair that is returned, and whether
// anything lies within max_distance. Distances are compared by their correctly ordered squares, within 6 ulp of the
// exact ones.
//
// Results. The distance is within 4 ulp. The coordinates of `point` are within 14 ulp of the largest coordinate of the
// asset's bounds, those of `on_shape` within 14 ulp of the largest one of the shape and of the asset, those of
// `face_normal` within 4 ulp of 1. Distances of segments between 0 and 2^-63 lattice steps, which take segments of 2^26
// steps and more, are returned as 2^-63 steps.
//
// Inside. The winding number is counted exactly, in integers, along an axis, on a ray that is moved aside by
// infinitesimally little, alike for all triangles (the perturbation of Edelsbrunner and Mücke 1990).
//
// Winding number. The directions are those of a Fibonacci lattice on a half sphere and their opposites (Gonzalez 2010),
// the same on every machine. The value estimates the generalized winding number (Jacobson, Kavan and Sorkine-Hornung
// 2013), the solid angle of the surface over 4 pi; docs/numerics.md has measured errors. Each ray is exact.
