// Overlap queries: which triangles touch a shape.
//
// The triangles are a surface: a shape inside a closed mesh that touches no triangle overlaps none. Shapes are given in
// the space of the blob. Thread safety: any number of threads may query one blob. No call allocates. Numerics are
// described at the end of this file.
#pragma once

#include <cstdint>
#include <span>

#include <espalier/blob.hpp>
#include <espalier/base/function_ref.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

namespace detail {

struct Each;
struct WalkAccuracy;
using FindOverlaps = QueryStatus (*)(const BlobData& blob, const void* shape, Each& answer,
                                     const WalkAccuracy& accuracy);

/// Rounds a shape and finds the triangles that overlap it. Defined for each shape in lib/runtime/overlap: a program
/// links only those that it uses.
template <OverlapShape Shape>
QueryStatus find_overlaps_of(const BlobData& blob, const void* shape, Each& answer, const WalkAccuracy& accuracy);
template <>
QueryStatus find_overlaps_of<Sphere>(const BlobData& blob, const void* shape, Each& answer,
                                     const WalkAccuracy& accuracy);  // of its own, whichever file comes first

/// A shape of any type.
struct AnyShape {
    const void* shape;
    FindOverlaps find;

    template <OverlapShape Shape>
    explicit constexpr AnyShape(const Shape& any) noexcept : shape(&any), find(find_overlaps_of<Shape>) {}
};

YesNo overlaps(const Blob& blob, AnyShape shape) noexcept;
QueryStatus for_each_overlap(const Blob& blob, AnyShape shape, TriangleVisitor visit) noexcept;
Filled collect_overlaps(const Blob& blob, AnyShape shape, std::span<TriangleId> out, const Cursor& from) noexcept;

}  // namespace detail

/// Returns whether any triangle touches the shape.
///
/// Refuses a shape with invalid_argument: a NaN; an infinite coordinate, except of a Box; a negative radius; a plane
/// with an infinite normal or one shorter than 2^-126; more than max_planes planes. Refuses a shape that is too far
/// away or too large with out_of_range: the numerics state how far. An empty Box overlaps nothing. Infinite radii (of a
/// Sphere or Capsule), boxes and offsets are valid, and so are flat boxes, segments and points. Cost: expected O(log
/// n).
template <OverlapShape Shape>
[[nodiscard]] YesNo overlaps(const Blob& blob, const Shape& shape) noexcept {
    return detail::overlaps(blob, detail::AnyShape(shape));
}

/// Visits every triangle that touches the shape once, in the order of collect_overlaps(), until the visitor stops.
///
/// Returns ok, stopped, or a refusal as overlaps() does; then nothing was visited.
/// Cost: expected O(log n + k) for k triangles.
template <OverlapShape Shape>
QueryStatus for_each_overlap(const Blob& blob, const Shape& shape, TriangleVisitor visit) noexcept {
    return detail::for_each_overlap(blob, detail::AnyShape(shape), visit);
}

/// Writes every triangle that touches the shape, once: as many as `out` holds, from `from` on.
///
/// Status: ok if these were the last ones; output_full if there are more, then `next` resumes behind the last one that
/// was written; or a refusal as of overlaps(). Pages may have different sizes; an empty one reports whether there is
/// more. Nothing is kept between calls: `from` is the default or a `next` of the same blob and shape.
///
/// Order: ascending TriangleId. In a blob with duplicate references (Blob::duplicate_reference_count()) a triangle
/// comes at the first of its references that the query reaches. That order depends only on blob and shape. If such a
/// blob is not the baker's, its references may lie outside of their triangles' boxes: then a triangle may come twice or
/// not at all. Cost: as of for_each_overlap(); the walk to `from` decodes no triangle.
template <OverlapShape Shape>
Filled collect_overlaps(const Blob& blob, const Shape& shape, std::span<TriangleId> out,
                        const Cursor& from = {}) noexcept {
    return detail::collect_overlaps(blob, detail::AnyShape(shape), out, from);
}

}  // namespace espalier

// Numerics
//
// A shape is rounded once onto a grid finer than the lattice of the blob (docs/numerics.md). Whether a triangle touches
// the rounded shape is then decided exactly. Coordinates are rounded to 1/64 of a lattice step near the mesh, farther
// away to as much as float32 resolves there; normals of planes are turned by less than 2^-23 radians about the corner
// of the mesh's bounds. A LatticeBox is not rounded.
//
// Range. A Box and an offset may be anywhere, a Sphere less than 2^120 lattice steps away. Of other shapes those parts
// that matter must be within 2^36 lattice steps of the mesh: a capsule's ends; a box or triangle that may reach the
// mesh and is larger than that. Shapes beyond, and planes of a mesh that is itself 2^60 steps from the world's origin,
// are refused with out_of_range.
