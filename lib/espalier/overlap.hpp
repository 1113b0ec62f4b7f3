// Overlap queries: which triangles touch a shape.
//
// The triangles form a surface, not a solid: a shape that lies inside a closed mesh without touching a triangle
// overlaps nothing. Shapes are given in the blob's local space. Any number of threads may query the same blob, and no
// call allocates. Numerics are described at the end of this file.
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

/// Rounds a shape and finds the triangles that overlap it. Shapes are defined in files of lib/runtime/overlap, so that
/// a program links only those it uses.
template <OverlapShape Shape>
QueryStatus find_overlaps_of(const BlobData& blob, const void* shape, Each& answer, const WalkAccuracy& accuracy);
template <>
QueryStatus find_overlaps_of<Sphere>(const BlobData& blob, const void* shape, Each& answer,
                                     const WalkAccuracy& accuracy);  // declared here, whichever file comes first
template <>
QueryStatus find_overlaps_of<Capsule>(const BlobData& blob, const void* shape, Each& answer,
                                      const WalkAccuracy& accuracy);
template <>
QueryStatus find_overlaps_of<OrientedBox>(const BlobData& blob, const void* shape, Each& answer,
                                          const WalkAccuracy& accuracy);

/// A shape of any type, with the function that handles it.
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
/// Refuses with invalid_argument: a NaN; an infinite coordinate, except of a Box; a negative radius; a plane whose
/// normal is infinite or shorter than 2^-126; and more than max_planes planes. Refuses with out_of_range a shape that
/// is too far away or too large; the numerics below state the limits. Infinite radii of a Sphere or Capsule, infinite
/// boxes and infinite offsets are valid, and so are flat boxes, segments and points. An empty Box overlaps nothing.
/// Expected cost: O(log n).
template <OverlapShape Shape>
[[nodiscard]] YesNo overlaps(const Blob& blob, const Shape& shape) noexcept {
    return detail::overlaps(blob, detail::AnyShape(shape));
}

/// Visits each triangle that touches the shape once, in the order of collect_overlaps(), until the visitor stops.
///
/// Returns ok, stopped, or a refusal like overlaps(), in which case nothing was visited. Expected cost: O(log n + k)
/// for k triangles.
template <OverlapShape Shape>
QueryStatus for_each_overlap(const Blob& blob, const Shape& shape, TriangleVisitor visit) noexcept {
    return detail::for_each_overlap(blob, detail::AnyShape(shape), visit);
}

/// Writes each triangle that touches the shape once, starting from `from` and as many as `out` holds.
///
/// Returns ok if these were the last ones; output_full if there are more, and then `next` resumes after the last one
/// written; or a refusal like overlaps(). Pages may differ in size, and an empty `out` tells whether there are more.
/// Nothing is remembered between calls: pass as `from` either the default or the `next` of the same blob and shape.
///
/// The order is that of ascending TriangleId. In a blob with duplicate references (Blob::duplicate_reference_count()),
/// a triangle comes at the first of its references that the query reaches; that order, too, depends only on the blob
/// and the shape. If such a blob does not come from the baker, its references may lie outside the boxes of their
/// triangles, and then a triangle may be written twice or not at all. The cost is that of for_each_overlap(); no
/// triangle is decoded on the way to `from`.
template <OverlapShape Shape>
Filled collect_overlaps(const Blob& blob, const Shape& shape, std::span<TriangleId> out,
                        const Cursor& from = {}) noexcept {
    return detail::collect_overlaps(blob, detail::AnyShape(shape), out, from);
}

}  // namespace espalier

// Numerics
//
// A shape is rounded once, onto a grid finer than the blob's lattice (docs/numerics.md); whether a triangle touches the
// rounded shape is then decided exactly. Near the mesh, coordinates are rounded to 1/64 of a lattice step; farther
// away, as finely as float32 resolves there. The normals of planes turn by less than 2^-23 radians about the corner of
// the mesh's bounds. A LatticeBox is not rounded.
//
// Range. A Box and an offset may be anywhere, and a Sphere less than 2^120 lattice steps away. Of the other shapes, the
// parts that matter must be within 2^36 lattice steps of the mesh: the ends of a capsule, or a box or triangle that is
// larger than that and may reach the mesh. Shapes beyond that, and planes for a mesh that is itself 2^60 steps from the
// world's origin, are refused with out_of_range.
