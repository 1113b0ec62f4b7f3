// The point of the surface that is closest to a given point, segment or box, and the triangles that are.
//
// Numbers. The point is rounded once onto a grid finer than the asset's lattice (docs/numerics.md). Distances are
// compared by their correctly ordered squares, within 6 ulp of the exact ones; of equal ones the lowest storage index
// wins. Whether anything lies within max_distance is decided exactly. The distance is within 4 ulp, the point's
// coordinates within 14 ulp of the largest coordinate of the asset's bounds.
// Arguments. Any bit pattern is safe. A NaN, a point that is infinite or more than 2^120 lattice steps away, or a
// negative max_distance finds nothing, O(1).
#pragma once

#include <cstddef>
#include <span>

#include <espalier/blob.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// Corners are those of the blob (walk.hpp); which of the source's they are, OriginalTriangle says.
struct Nearest {
    Vec3 point;
    float distance = 0.0f;
    float u = 0.0f;  ///< barycentric weight of corner b
    float v = 0.0f;  ///< barycentric weight of corner c; corner a has 1 - u - v
    Triangle triangle;
    Feature feature = Feature::face;  ///< the part of the triangle that the point lies on, exactly
};

/// The closest point of the surface within max_distance (which may be infinite) of `point`. `nearest` is untouched when
/// there is none.
bool closest_point(const Blob& blob, Vec3 point, float max_distance, Nearest& nearest) noexcept;

/// The triangles closest to `point`, as many as `nearest` has places and lie within max_distance, each with its own
/// closest point, sorted as closest_point chooses: by distance (squared, before the root is rounded), of equal ones by
/// storage index. The first is what closest_point answers; a triangle that has copies appears once. How many there are;
/// the rest of `nearest` is untouched. O(log(places)) for each triangle that comes nearer than those found before,
/// O(places) in a blob with copies.
std::size_t closest_triangles(const Blob& blob, Vec3 point, float max_distance, std::span<Nearest> nearest) noexcept;

/// The closest pair of points, one of a shape and one of the surface.
struct NearestPair {
    Vec3 on_shape;
    Vec3 on_surface;
    float distance = 0.0f;
    float u = 0.0f;  ///< barycentric weight of corner b
    float v = 0.0f;  ///< barycentric weight of corner c; corner a has 1 - u - v
    Triangle triangle;
};

/// The triangle closest to a segment, which may have length zero, or to a box, all of it and not its sides only, and a
/// pair of points that are as close. Distance 0 exactly where they share a point, of which one is told then.
///
/// ok, and no_triangle at max_distance when nothing is within max_distance (which may be infinite), or the box is
/// empty; the points are zero then. invalid_argument for a NaN, an infinity in the shape or a negative max_distance;
/// out_of_range for a shape that reaches more than 2^36 lattice steps from any vertex of the asset along an axis.
/// `pair` is untouched unless ok. The shape is rounded as finely as its farthest coordinate allows, to 2^-6 of a
/// lattice step at most. Distances are ordered, and numbers as exact, as closest_point's; the coordinates of on_shape
/// are within 14 ulp of the largest one of the shape and of the asset. Distances of segments between 0 and 2^-63
/// lattice steps, which take segments of 2^26 steps and more, are told as 2^-63 steps.
QueryStatus closest_to_segment(const Blob& blob, const Segment& segment, float max_distance,
                               NearestPair& pair) noexcept;
QueryStatus closest_to_box(const Blob& blob, const Box& box, float max_distance, NearestPair& pair) noexcept;

}  // namespace espalier
