// How far a query moves when it is rounded.
//
// Each query is rounded once, onto a grid at least as fine as the blob's lattice, and the rounded query is answered
// exactly. These functions return a bound on that rounding in world units: every point of the shape moves by no more.
// So a distance changes by no more, and no surface that is farther from the shape's boundary is judged otherwise.
// Blob::max_error bounds what baking moved; the sum of both bounds an answer's error against the source.
//
// Arguments. Any bit pattern is safe. A NaN, an infinity, a negative radius or a zero direction is an invalid_argument;
// a point at 2^36 lattice steps from the asset or farther is out_of_range, of a ray's origin at 2^120.
// A blob without triangles has nothing to round for: 0.
// Cost. O(1).
//
// Numerics. The bound is a function of the blob and of how far the query lies and reaches, rounded up. At 16 bits and
// near the asset it is sqrt(3) / 128 of a lattice step and a little more. The largest move among queries that lie and
// reach as far is at least an eighth of it (docs/numerics.md). Sweeps, planes and pairs of blobs are rounded onto
// coarser grids, which are described there.
#pragma once

#include <espalier/blob.hpp>
#include <espalier/ray.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// Returns how far rounding moves the query at most. For a ray: how far the rounded ray is from it inside of the
/// asset's box; its window does not count. For a Box: parts that are more than a lattice step outside of the asset's
/// box may move farther in `overlaps`, where there is nothing to meet.
[[nodiscard]] Result<float> rounding_error(const Blob& blob, const Vec3& point) noexcept;
[[nodiscard]] Result<float> rounding_error(const Blob& blob, const Ray& ray) noexcept;
[[nodiscard]] Result<float> rounding_error(const Blob& blob, const Segment& segment) noexcept;
[[nodiscard]] Result<float> rounding_error(const Blob& blob, const Sphere& sphere) noexcept;
[[nodiscard]] Result<float> rounding_error(const Blob& blob, const Capsule& capsule) noexcept;
[[nodiscard]] Result<float> rounding_error(const Blob& blob, const Box& box) noexcept;
[[nodiscard]] Result<float> rounding_error(const Blob& blob, const OrientedBox& box) noexcept;
[[nodiscard]] Result<float> rounding_error(const Blob& blob, const Corners& triangle) noexcept;

}  // namespace espalier
