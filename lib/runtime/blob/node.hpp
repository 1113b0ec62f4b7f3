// Nodes of both kinds, decoded to integers on the lattice, and what leaves of all kinds share: a place in a node, and
// vertices by number. The layouts are in format/nodes.hpp. Each kind of node offers:
// `node_children()`, `leaf_children()`, `first_child()`; the boxes of its children as `low(axis, child, bits)` and
// `high(axis, child, bits)`; where the block of its leaves is.
#pragma once

#include <espalier/blob.hpp>
#include <runtime/lattice/round_ray.hpp>

namespace espalier::detail {

// What nodes of all kinds store alike: their children in one word, rows of planes, and where their leaves lie.

/// The bytes of a node, by the places that its layout gives.
template <std::size_t place_of_children, std::size_t leaf_block_at, std::size_t low_at, std::size_t high_at,
          std::size_t row_bytes>
struct NodeBytes {
    static constexpr std::size_t children_at = place_of_children;

    const std::byte* bytes;

    [[nodiscard]] ESPALIER_ALWAYS_INLINE std::uint32_t first_child() const {
        return load_u32(bytes + children_at) & 0xFFFFFFu;
    }
    [[nodiscard]] const std::byte* low_planes(int axis) const {
        return bytes + low_at + row_bytes * static_cast<std::size_t>(axis);
    }
    [[nodiscard]] const std::byte* high_planes(int axis) const {
        return bytes + high_at + row_bytes * static_cast<std::size_t>(axis);
    }
    /// Where the block of its leaves starts, in units of 4 bytes.
    [[nodiscard]] std::uint32_t leaf_block_place() const { return load_u32(bytes + leaf_block_at); }
    [[nodiscard]] const std::byte* leaf_block(const BlobData& blob) const {
        return blob.leaves + 4 * std::size_t{leaf_block_place()};
    }
};

// A node of profiles `balanced` and `small`, decoded: one cache line. The layout is in format/nodes.hpp. What comes out
// is integers on the lattice: boxes as base + plane * 2^shift.

/// Where the pieces of a node are.
struct PackedNode : NodeBytes<format::packed_node::children_at, format::packed_node::leaf_block_at,
                              format::packed_node::lo_at, format::packed_node::hi_at, format::packed_node::row_bytes> {
    static constexpr unsigned max_children = format::packed_node::max_children;
    static constexpr std::size_t size = format::packed_node::bytes;

    [[nodiscard]] unsigned node_children() const { return node_children_in(load_u8(bytes + children_at + 3)); }
    [[nodiscard]] unsigned leaf_children() const { return load_u8(bytes + children_at + 3) >> 4; }
    /// From the byte behind the number of the first child.
    static constexpr unsigned node_children_in(std::uint32_t counts) { return counts & 15u; }
    [[nodiscard]] ESPALIER_ALWAYS_INLINE unsigned shift(int axis) const {
        return (load_u16(bytes + format::packed_node::shifts_at) >> (5 * axis)) & 31u;
    }
    [[nodiscard]] std::int32_t base(int axis, unsigned bits) const {
        const std::byte* at = bytes + (format::packed_node::base_at + 2 * static_cast<std::size_t>(axis));
        return static_cast<std::int32_t>(load_u16(at) << format::unit_shift(bits));
    }
    [[nodiscard]] std::int32_t plane(int axis, const std::byte* at, unsigned bits) const {
        return base(axis, bits) + static_cast<std::int32_t>(load_u8(at) << shift(axis));
    }
    [[nodiscard]] ESPALIER_SHARED_CODE std::int32_t low(int axis, unsigned child, unsigned bits) const {
        return plane(axis, low_planes(axis) + child, bits);
    }
    [[nodiscard]] ESPALIER_SHARED_CODE std::int32_t high(int axis, unsigned child, unsigned bits) const {
        return plane(axis, high_planes(axis) + child, bits);
    }
};

// A node of profile `fast`: numbers in whole bytes, which lanes load as they are. The layout is in format/nodes.hpp.
// What comes out is integers on the lattice.

/// Where the pieces of a node are.
struct PlainNode : NodeBytes<format::plain_node::children_at, format::plain_node::leaf_block_at,
                             format::plain_node::lo_at, format::plain_node::hi_at, format::plain_node::row_bytes> {
    static constexpr unsigned max_children = format::plain_node::max_children;
    static constexpr std::size_t size = format::plain_node::bytes;

    [[nodiscard]] unsigned node_children() const { return load_u8(bytes + children_at + 3); }
    [[nodiscard]] unsigned leaf_children() const { return load_u8(bytes + format::plain_node::leaf_children_at); }
    /// From the byte behind the number of the first child.
    static constexpr unsigned node_children_in(std::uint32_t counts) { return counts; }
    [[nodiscard]] ESPALIER_SHARED_CODE std::int32_t low(int axis, unsigned child, unsigned bits) const {
        return static_cast<std::int32_t>(load_u16(low_planes(axis) + 2 * std::size_t{child})
                                         << format::unit_shift(bits));
    }
    [[nodiscard]] ESPALIER_SHARED_CODE std::int32_t high(int axis, unsigned child, unsigned bits) const {
        const std::uint32_t next = load_u16(high_planes(axis) + 2 * std::size_t{child}) + 1;
        return static_cast<std::int32_t>((next << format::unit_shift(bits)) - 1);
    }
    /// How the leaf of that number is coded, in 24 bits; above them lies what follows in the node.
    [[nodiscard]] std::uint32_t leaf_descriptor(unsigned number) const {
        return load_u32(bytes + format::plain_node::leaves_at + format::plain_leaf::descriptor_bytes * number);
    }
};

/// Which children a node has, read as one word: read apart, its fields cost a walk two more loads and a shift from one
/// node to the next.
template <class Node>
class NodeChildren {
public:
    explicit NodeChildren(Node node) : word_(as_if_changed(load_u32(node.bytes + Node::children_at))) {}
    [[nodiscard]] std::uint32_t first() const { return word_ & 0xFFFFFFu; }
    /// How many are nodes; the others are leaves.
    [[nodiscard]] unsigned nodes() const { return Node::node_children_in(word_ >> 24); }

private:
    std::uint32_t word_;
};

template <class Node>
inline constexpr unsigned every_child_of = (1u << Node::max_children) - 1u;

/// A bit for each child.
template <class Node>
ESPALIER_ALWAYS_INLINE inline unsigned all_children(const Node& node) {
    return (1u << (node.node_children() + node.leaf_children())) - 1u;
}

template <class Node>
inline Node node_at(const BlobData& blob, std::uint32_t index) {
    return {blob.nodes + std::size_t{index} * Node::size};
}

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
        // mutant(< -> <=) sanitizer: a fourth corner is behind the end of an array
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
