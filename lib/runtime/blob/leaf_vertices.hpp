// What all kinds of leaves share: vertices by number, as offsets from a corner.
#pragma once

#include <cstddef>
#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/base/bytes.hpp>
#include <runtime/base/small_code.hpp>
#include <runtime/blob/node.hpp>
#include <runtime/lattice/round_ray.hpp>
#include <runtime/lattice/triangle.hpp>

namespace espalier::detail {

/// Where a leaf is: for walks whose visitors decode it themselves.
template <class NodeKind>
struct LeafPlace {
    using Node = NodeKind;

    const BlobData* blob;
    Node node;
    unsigned number;  ///< among the node's leaves
};
template <class Leaf>
using PlaceOf = LeafPlace<typename Leaf::Node>;

template <class Node>
[[gnu::always_inline]] inline void decode_leaf(const BlobData& blob, Node node, unsigned number,
                                               LeafPlace<Node>& place) {
    place = {&blob, node, number};
}

/// The leaf of a kind that is child `node.node_children() + number` of the node.
template <class Leaf>
inline Leaf leaf_at(const BlobData& blob, typename Leaf::Node node, unsigned number) {
    Leaf leaf;
    decode_leaf(blob, node, number, leaf);
    return leaf;
}

/// The vertices of a triangle, by their numbers in its leaf.
struct LeafCorners {
    std::uint8_t vertex[3];

    constexpr LeafCorners(unsigned a, unsigned b, unsigned c)
        : vertex{static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(c)} {}
};

/// Each kind of leaf adds: `anchor(axis)`, what its coordinates count from; `offset(axis, vertex)`, what a vertex adds
/// to that; `counts_from_zero`, whether anchors are 0; `may_have_duplicates`, whether blobs with such leaves may have
/// copies of triangles (docs/format.md, `copies`).
template <class NodeKind>
struct LeafVertices {
    using Node = NodeKind;

    Node node;  ///< whose child the leaf is
    const BlobData* blob;
    std::uint8_t vertex_count;
    std::uint8_t number;     ///< among the node's leaves
    std::uint8_t size_bits;  ///< of a number that is more than the distance of any two vertices along an axis

    /// Among the children of its node.
    [[nodiscard]] unsigned child() const { return node.node_children() + number; }
};

template <class Leaf>
inline LatticeTriangle triangle_of(const Leaf& leaf, LeafCorners corners) {
    LatticeTriangle triangle;
    for (int k = 0; k < 3; ++k) {
        const std::int32_t from = leaf.anchor(k);
        for (int corner = 0; corner < 3; ++corner)
            triangle.corner[corner][k] = from + leaf.offset(k, corners.vertex[corner]);
    }
    return triangle;
}

/// A vertex as seen from the ray's origin, in the ray's units.
template <class Leaf>
ESPALIER_SHARED_CODE inline void place_vertex(const Leaf& leaf, unsigned vertex, const IntegerRay& ray,
                                              std::int32_t* place) {
    for (int k = 0; k < 3; ++k)
        place[k] = ((leaf.anchor(k) + leaf.offset(k, vertex)) << ray.fraction_bits) - ray.origin[k];
}

}  // namespace espalier::detail
