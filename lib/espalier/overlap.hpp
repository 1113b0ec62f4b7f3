// Volumes against a blob. The triangles are a surface: a volume inside a closed mesh that touches none overlaps none.
//
// Shapes. Sphere, Capsule, Box, OrientedBox, a triangle (Corners), a convex set of planes (a span of Plane: a frustum,
// a k-DOP; not necessarily bounded, at most max_planes).
//
// Numbers. A shape is rounded once onto a grid finer than the asset's lattice (docs/numerics.md); whether a triangle
// overlaps is then decided exactly, and touching counts. Coordinates are rounded to 1/64 of a lattice step near the
// asset, farther away to as much as float32 resolves there; normals of planes are turned by less than 2^-23 radians
// about the corner of the asset's bounds.
//
// Arguments. Any bit pattern is safe. What follows overlaps nothing, O(1), and collect_overlaps says invalid_argument:
// a NaN; an infinite coordinate, but for those of a Box; a negative radius; a normal that is zero (below 2^-126) or
// infinite; more than max_planes planes. Otherwise infinite radii, boxes and offsets mean what they say; an empty Box
// (min above max) overlaps nothing; no planes at all are all of space; flat shapes, segments and points are shapes too.
// Distance. A Sphere may be up to 2^120 lattice steps away, a Box and an offset anywhere. Of other shapes those parts
// that matter must be within 2^36 lattice steps of the asset: a capsule's ends; a box or triangle that may reach the
// asset and is larger than that. Beyond, and for planes of an asset that is itself 2^60 steps from the world's origin,
// the answer is out_of_range: overlaps says false, for_each_overlap visits nothing and says false.
#pragma once

#include <cstdint>
#include <span>

#include <espalier/blob.hpp>
#include <espalier/function_ref.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// Of a convex set. 26-DOPs fit.
inline constexpr std::size_t max_planes = 32;

/// Whether any triangle overlaps the shape.
[[nodiscard]] bool overlaps(const Blob& blob, const Sphere& sphere) noexcept;
[[nodiscard]] bool overlaps(const Blob& blob, const Capsule& capsule) noexcept;
[[nodiscard]] bool overlaps(const Blob& blob, const Box& box) noexcept;
[[nodiscard]] bool overlaps(const Blob& blob, const OrientedBox& box) noexcept;
[[nodiscard]] bool overlaps(const Blob& blob, const Corners& triangle) noexcept;
[[nodiscard]] bool overlaps(const Blob& blob, std::span<const Plane> planes) noexcept;

/// Every overlapping triangle, in storage order, until the visitor answers stop. True when it saw them all.
/// The visitor must not throw. False at once, and nothing is visited, when blob.copy_count() is not 0.
bool for_each_overlap(const Blob& blob, const Sphere& sphere, FunctionRef<Visit(Triangle)> visit);
bool for_each_overlap(const Blob& blob, const Capsule& capsule, FunctionRef<Visit(Triangle)> visit);
bool for_each_overlap(const Blob& blob, const Box& box, FunctionRef<Visit(Triangle)> visit);
bool for_each_overlap(const Blob& blob, const OrientedBox& box, FunctionRef<Visit(Triangle)> visit);
bool for_each_overlap(const Blob& blob, const Corners& triangle, FunctionRef<Visit(Triangle)> visit);
bool for_each_overlap(const Blob& blob, std::span<const Plane> planes, FunctionRef<Visit(Triangle)> visit);

/// What collect_overlaps did.
struct OverlapPage {
    QueryStatus status = QueryStatus::ok;  ///< ok: these were the last; output_full: there are more; else why not
    std::uint32_t count = 0;               ///< triangles written
    /// What to pass as `first` to go on: with output_full the storage index of the first triangle that found no room;
    /// with ok the blob's triangle_count; else `first` as it was.
    std::uint32_t next = 0;
};

/// The overlapping triangles with storage indices from `first` on, in storage order, as many as `out` holds. Page after
/// page gives each triangle exactly once, and nothing is kept in between: not even the array needs to be of one size. A
/// page walks over what lies before it without decoding any of its triangles. An array of no elements asks whether
/// there is anything left.
OverlapPage collect_overlaps(const Blob& blob, const Sphere& sphere, std::span<Triangle> out,
                             std::uint32_t first = 0) noexcept;
OverlapPage collect_overlaps(const Blob& blob, const Capsule& capsule, std::span<Triangle> out,
                             std::uint32_t first = 0) noexcept;
OverlapPage collect_overlaps(const Blob& blob, const Box& box, std::span<Triangle> out,
                             std::uint32_t first = 0) noexcept;
OverlapPage collect_overlaps(const Blob& blob, const OrientedBox& box, std::span<Triangle> out,
                             std::uint32_t first = 0) noexcept;
OverlapPage collect_overlaps(const Blob& blob, const Corners& triangle, std::span<Triangle> out,
                             std::uint32_t first = 0) noexcept;
OverlapPage collect_overlaps(const Blob& blob, std::span<const Plane> planes, std::span<Triangle> out,
                             std::uint32_t first = 0) noexcept;

}  // namespace espalier
