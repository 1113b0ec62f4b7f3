// Distance queries: the point of the surface closest to a point, a segment or a box; the closest triangles; and, for
// closed surfaces, whether a point is inside.
//
// Coordinates and distances are in the blob's local space and units. Every query refuses, in O(1), a blob that is not
// open (not_open), and a NaN, an infinite coordinate or a negative max_distance (invalid_argument). A max_distance may
// be infinite.
//
// Any number of threads may query the same blob, and no call allocates. Numerics are described at the end of this file.
#pragma once

#include <concepts>
#include <cstdint>
#include <span>

#include <espalier/blob.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// The result of a distance query. Converts to true if there is a closest point; a miss has an infinite distance and
/// no_triangle.
struct [[nodiscard]] ClosestPoint {
    Vec3 point;        ///< the closest point, on the surface
    Vec3 on_shape;     ///< the point of the shape at that distance; a query point is returned as given
    Vec3 face_normal;  ///< unit length, pointing away from the triangle's front; zero for a triangle without area
    float distance = infinity;
    float u = 0.0f;                              ///< barycentric weight of corner b
    float v = 0.0f;                              ///< barycentric weight of corner c; corner a has 1 - u - v
    TriangleId triangle;                         ///< in baked order; triangle_at() returns its corners
    QueryStatus status = QueryStatus::not_open;  ///< ok, not_found, or why the query was refused
    Feature feature = Feature::face;             ///< the smallest part of the triangle that contains the point, exactly
    Side side = Side::front;  ///< back if the whole shape is behind the triangle's plane, exactly; else front
    std::uint8_t reserved = 0;

    explicit constexpr operator bool() const noexcept { return status == QueryStatus::ok; }
};

/// Returns the closest point of the surface within max_distance. Of equally close triangles, the one with the lowest
/// index wins.
///
/// Refuses a point 2^120 lattice steps or more away (out_of_range). Expected cost: O(log n); for the worst case see
/// docs/queries/README.md, Bounded.
ClosestPoint closest_point(const Blob& blob, Vec3 point, float max_distance = infinity) noexcept;

namespace detail {

ClosestPoint closest_to_segment(const Blob& blob, const Segment& segment, float max_distance) noexcept;
ClosestPoint closest_to_box(const Blob& blob, const Box& box, float max_distance) noexcept;

}  // namespace detail

/// Returns the closest pair of points, one on the segment and one on the surface. The segment may have length zero. The
/// distance is 0 exactly if segment and surface share a point, in which case the result is one such point.
///
/// Refuses a segment that extends 2^36 lattice steps or more from any vertex of the asset along an axis (out_of_range).
/// The cost is that of a point, but several times as much for each triangle.
///
/// A Box is treated the same way, as a solid; an empty one has no closest point (not_found). The function is a
/// template, so that braces mean a point: closest_point(blob, {x, y, z}).
template <class Shape>
requires std::same_as<Shape, Segment> || std::same_as<Shape, Box> ClosestPoint
closest_point(const Blob& blob, const Shape& shape, float max_distance = infinity)
noexcept {
    if constexpr (std::same_as<Shape, Segment>) return detail::closest_to_segment(blob, shape, max_distance);
    else return detail::closest_to_box(blob, shape, max_distance);
}

/// Writes the closest triangles within max_distance, as many as `nearest` has room for, each with its own closest
/// point. They are sorted by distance, and by index if equally close; the first is the result of closest_point(). A
/// triangle with duplicate references appears once. The rest of `nearest` is not written.
///
/// The status is ok even if more triangles are within max_distance. Refuses what closest_point() refuses. Cost:
/// O(log(nearest.size())) for each triangle that is closer than those found so far, or O(nearest.size()) in a blob with
/// duplicate references.
Filled closest_triangles(const Blob& blob, Vec3 point, std::span<ClosestPoint> nearest,
                         float max_distance = infinity) noexcept;

/// Returns whether the point is inside the closed surface. A point on the surface counts as inside; a point outside the
/// asset's box is outside, however far away.
///
/// Refuses a surface that is not closed (not_closed). A point is inside if its winding number is not zero: where shells
/// overlap it is inside both, a cavity whose triangles face inward is outside, and a surface that was baked inside out
/// has the same inside. Triangles need not share vertices: a corner may lie on the edge of another triangle. Cost: the
/// query visits the triangles along the shortest axis-parallel way from the point out of the asset's box.
YesNo contains(const Blob& blob, Vec3 point) noexcept;

/// Returns the closest point of the surface, with a negative distance if the query point is inside. If nothing is
/// within max_distance, the status is not_found and the distance is max_distance, negated inside.
///
/// Refuses what contains() and closest_point() refuse, and costs as much as both.
ClosestPoint signed_distance(const Blob& blob, Vec3 point, float max_distance = infinity) noexcept;

/// The largest number of directions that winding_number() takes.
inline constexpr unsigned max_winding_directions = 4096;

/// Returns approximately how often the surface, which may be open, winds around the point: the mean of what rays in
/// several directions count. `directions` is from 2 to max_winding_directions, and an odd number counts as the next
/// even one.
///
/// Where the surface is closed around the point, all rays count the same and the value is a whole number: 1 inside, 0
/// outside, more where shells overlap, and -1 inside a surface that was baked inside out. Rays that leave through a
/// hole count nothing there, so the value is a fraction, of which more than 0.5 usually means inside. If the point is
/// within rounding of the surface, the value is that of either side, or one between.
///
/// Refuses a NaN or an infinity and any other number of directions (invalid_argument), and points that raycast() would
/// refuse as origins. Cost: one for_each_crossing() for each direction.
[[nodiscard]] Result<float> winding_number(const Blob& blob, Vec3 point, unsigned directions = 64) noexcept;

}  // namespace espalier

// Numerics
//
// Rounding. A point is rounded once, onto a grid finer than the asset's lattice (docs/numerics.md). A segment or a box
// is rounded as finely as its farthest coordinate allows, at the finest to 2^-6 of a lattice step.
// advanced/rounding.hpp returns bounds.
//
// Decisions. They are exact for the rounded query: the `side` and `feature` of the returned pair, and whether anything
// lies within max_distance. Distances are compared by their squares, which are correctly ordered and within 6 ulp of
// the exact ones.
//
// Results. The distance is within 4 ulp. The coordinates of `point` are within 14 ulp of the largest coordinate of the
// asset's bounds, those of `on_shape` within 14 ulp of the largest coordinate of the shape and the asset, and those of
// `face_normal` within 4 ulp of 1. A segment's distance between 0 and 2^-63 lattice steps, which takes a segment of
// 2^26 steps or more, is returned as 2^-63 steps.
//
// Inside. The winding number is counted exactly, in integers, along a ray parallel to an axis. The ray is displaced
// infinitesimally, in the same way for all triangles (Edelsbrunner and Mücke 1990).
//
// Winding number. The directions are those of a Fibonacci lattice on a half sphere and their opposites (Gonzalez 2010),
// the same on every machine. The value estimates the generalized winding number (Jacobson, Kavan and Sorkine-Hornung
// 2013), which is the solid angle of the surface divided by 4 pi; docs/numerics.md has measured errors. Each ray is
// exact.
