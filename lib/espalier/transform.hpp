// Placing blobs and shapes: rotations, transforms, and blobs at a position in the world.
//
// A blob is queried in its own local space, and a Transform leads from there to the world. to_local() moves a shape
// into local space; to_world() moves a point back, and normal_to_world() a normal. Distances in the world are those in
// local space times the scale, while the t of rays and sweeps, triangles, features and sides are the same in both.
// These calls depend on nothing but their arguments, so any number of threads may make them. Numerics are described at
// the end of this file.
#pragma once

#include <espalier/blob.hpp>
#include <espalier/ray.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// A rotation. It may have any length but zero: q, 2 q and -q are the same rotation. The default does not rotate.
struct Quaternion {
    float x = 0.0f;
    float y = 0.0f;
    float z = 0.0f;
    float w = 1.0f;
    friend constexpr bool operator==(const Quaternion&, const Quaternion&) = default;
};

/// A rotation, a translation and a uniform scale: x becomes rotation * (scale * x) + translation. The default leaves
/// every point where it is.
struct Transform {
    Quaternion rotation;
    Vec3 translation;
    float scale = 1.0f;  ///< must be above 0
    friend constexpr bool operator==(const Transform&, const Transform&) = default;
};

/// A blob at a position in the world, for the queries on two blobs in pair.hpp, whose results are in world space. All
/// other queries take the Blob itself; move their shapes with to_local(). A PlacedBlob refers to its blob, which must
/// outlive it, so a temporary blob does not compile.
class PlacedBlob {
public:
    // NOLINTNEXTLINE(google-explicit-constructor): a blob is placed at the origin
    constexpr PlacedBlob(const Blob& blob, const Transform& transform = {}) noexcept
        : blob_(&blob), transform_(transform) {}
    PlacedBlob(const Blob&& blob, const Transform& transform = {}) = delete;

    [[nodiscard]] constexpr const Blob& blob() const noexcept { return *blob_; }
    [[nodiscard]] constexpr const Transform& transform() const noexcept { return transform_; }

private:
    const Blob* blob_;
    Transform transform_;
};

/// Moves a point or a shape from the world into the local space of the transform. Of a ConvexHull, move each vertex.
///
/// Every bit pattern is a safe argument. If the transform is not valid, coordinates become NaN, which every query
/// refuses. That is so if a number is not finite, the rotation has length zero, or the scale is not between 2^-100 and
/// 2^100. O(1).
[[nodiscard]] Vec3 to_local(const Transform& transform, const Vec3& point) noexcept;
[[nodiscard]] Segment to_local(const Transform& transform, const Segment& segment) noexcept;
[[nodiscard]] Sphere to_local(const Transform& transform, const Sphere& sphere) noexcept;
[[nodiscard]] Capsule to_local(const Transform& transform, const Capsule& capsule) noexcept;
[[nodiscard]] Triangle to_local(const Transform& transform, const Triangle& triangle) noexcept;
/// Returns an oriented box. An empty box has no oriented form and becomes NaN.
[[nodiscard]] OrientedBox to_local(const Transform& transform, const Box& box) noexcept;
[[nodiscard]] OrientedBox to_local(const Transform& transform, const OrientedBox& box) noexcept;
[[nodiscard]] Cone to_local(const Transform& transform, const Cone& cone) noexcept;
/// Moves a single plane. Of a ConvexVolume, move each plane.
[[nodiscard]] Plane to_local(const Transform& transform, const Plane& plane) noexcept;
/// Keeps t: the same t means the same point of the ray in both spaces.
[[nodiscard]] Ray to_local(const Transform& transform, const Ray& ray) noexcept;
/// Returns the transform from the local space of `inner` to that of `outer`, that is, `inner` as seen from `outer`.
[[nodiscard]] Transform to_local(const Transform& outer, const Transform& inner) noexcept;
/// Rotates and scales a direction or a displacement, without translating it.
[[nodiscard]] Vec3 direction_to_local(const Transform& transform, const Vec3& direction) noexcept;

/// Moves a point from local space into the world. Returns NaN where to_local() does. O(1).
[[nodiscard]] Vec3 to_world(const Transform& transform, const Vec3& point) noexcept;
/// Rotates and scales a direction or a displacement, without translating it.
[[nodiscard]] Vec3 direction_to_world(const Transform& transform, const Vec3& direction) noexcept;
/// Rotates a normal without scaling it: unit length is kept up to rounding, and zero stays zero. Only the rotation is
/// read; the result is NaN if that has length zero or is not finite.
[[nodiscard]] Vec3 normal_to_world(const Transform& transform, const Vec3& normal) noexcept;

/// Returns a point or a shape moved by a displacement, with one float addition for each coordinate. O(1).
[[nodiscard]] Vec3 translated(const Vec3& point, const Vec3& displacement) noexcept;
[[nodiscard]] Segment translated(const Segment& segment, const Vec3& displacement) noexcept;
[[nodiscard]] Sphere translated(const Sphere& sphere, const Vec3& displacement) noexcept;
[[nodiscard]] Capsule translated(const Capsule& capsule, const Vec3& displacement) noexcept;
[[nodiscard]] Triangle translated(const Triangle& triangle, const Vec3& displacement) noexcept;
[[nodiscard]] Box translated(const Box& box, const Vec3& displacement) noexcept;
[[nodiscard]] OrientedBox translated(const OrientedBox& box, const Vec3& displacement) noexcept;
[[nodiscard]] Cone translated(const Cone& cone, const Vec3& displacement) noexcept;
[[nodiscard]] Ray translated(const Ray& ray, const Vec3& displacement) noexcept;

/// Converts an affine matrix, given in rows, to a transform. Coordinate i of the matrix's result is rows[i][0] * x +
/// rows[i][1] * y + rows[i][2] * z + rows[i][3].
///
/// Refuses a matrix that no Transform can represent (invalid_argument): one with a number that is not finite, a mirror,
/// shear, unequal scale, or a matrix of zeros. Refuses a scale outside 2^-100 .. 2^100 (out_of_range). The dot product
/// of two columns may be off by 2^-12 of the square of the scale, and even a product of many float matrices stays below
/// that. O(1).
[[nodiscard]] Result<Transform> transform_from_matrix(const float (&rows)[3][4]) noexcept;

}  // namespace espalier

// Numerics. All calls compute in float, in a fixed order and without fused operations. They return the same bits on
// every machine, even where subnormal numbers are flushed to zero; only a NaN may have other bits. Coordinates,
// products and quotients below 2^-100 count as zero. The default transform changes no bit, and rotations by multiples
// of 90 degrees about an axis (quaternions of components 0, 1 and -1) do not round anything.
//
// Errors against real arithmetic, unless something overflows or is below 2^-100; |v| is the length of v:
//
//   to_local, a point p        each coordinate within 2^-19 * |p - translation| / scale
//   to_world, a point p        each coordinate within 2^-19 * scale * |p| + 2^-24 * |result|
//   a direction d              each coordinate within 2^-19 * |d| / scale, or * scale
//   a normal                   each coordinate within 2^-19 * |normal|
//   a radius                   rounded once
//   a plane                    the normal within 2^-19 * |normal|, the offset within
//                              2^-21 * (|normal| * |translation| + |offset|) / scale
//   a transform in another     the translation as a point, the rotation within 2^-19 radians, the scale rounded once
//   transform_from_matrix      entries within 2^-20 * scale for a matrix without shear; the scale is the root of the
//                              mean square of the columns' lengths
//
// docs/numerics.md has the proofs.
