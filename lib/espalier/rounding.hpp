// Rounding bounds: how far a query moves when it is rounded.
//
// Each query is rounded once, onto a grid at least as fine as the blob's lattice, and the rounded query is answered
// exactly. These functions return a bound on that rounding in the blob's units: no point of the shape moves farther. So
// a distance changes by no more, and the answer stays the same for every surface that is farther from the shape's
// boundary. Blob::max_error bounds what baking moved; the sum of both bounds an answer's error against the source.
//
// Cost: O(1). Thread safety: any number of threads may query one blob. No call allocates. Numerics are described at the
// end of this file.
#pragma once

#include <espalier/blob.hpp>
#include <espalier/ray.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// Returns how far rounding moves the query at most. For a ray: the largest distance of the rounded ray from it inside
/// of the asset's box, without regard to t_min and t_max. For a Box: parts that are more than a lattice step outside of
/// the asset's box may move farther in overlaps(), where they touch nothing. 0 for a blob without triangles.
///
/// Refuses a blob that is not open (not_open), a NaN, an infinity, a negative radius or a zero direction
/// (invalid_argument), and a point that is 2^36 lattice steps or more from the asset, or the origin of a ray that is
/// 2^120 or more (out_of_range).
Result<float> rounding_error(const Blob& blob, Vec3 point) noexcept;
Result<float> rounding_error(const Blob& blob, const Ray& ray) noexcept;
Result<float> rounding_error(const Blob& blob, const Segment& segment) noexcept;
Result<float> rounding_error(const Blob& blob, const Sphere& sphere) noexcept;
Result<float> rounding_error(const Blob& blob, const Capsule& capsule) noexcept;
Result<float> rounding_error(const Blob& blob, const Box& box) noexcept;
Result<float> rounding_error(const Blob& blob, const OrientedBox& box) noexcept;
Result<float> rounding_error(const Blob& blob, const Triangle& triangle) noexcept;

/// Returns how far rounding moves the shape of a sweep at most, at its start and anywhere on its way: place,
/// displacement and radius are all rounded. A body that touches nothing in one sweep may therefore touch the same
/// triangle at the start of the next one. To prevent that, move it away from the contact by the sum of both sweeps'
/// bounds and of the rounding of your own additions (docs/queries.md, Slide along a surface).
///
/// Refuses what sweep() refuses. 0 for a blob without triangles.
Result<float> rounding_error(const Blob& blob, const Sphere& sphere, Vec3 displacement) noexcept;
Result<float> rounding_error(const Blob& blob, const Capsule& capsule, Vec3 displacement) noexcept;
Result<float> rounding_error(const Blob& blob, const Box& box, Vec3 displacement) noexcept;

}  // namespace espalier

// Numerics
//
// The bound is a function of the blob and of how far the query lies and reaches, rounded up. At 16 bits and near the
// asset it is sqrt(3) / 128 of a lattice step and a little more. The largest move among queries that lie and reach as
// far is at least an eighth of it (docs/numerics.md). The grid of a sweep depends on its displacement and radius too.
// Planes and pairs of blobs are rounded onto other grids, which are described there.
