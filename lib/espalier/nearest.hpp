// The point of the surface that is closest to a given point, and the triangles that are.
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

}  // namespace espalier
