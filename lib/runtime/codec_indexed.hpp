// The `fast` profile, decoded: nodes of one cache line, leaves of bit-packed streams. The layout is in format.hpp.
// What comes out is integers on the lattice: boxes as base + plane * 2^shift, triangles as corners.
#pragma once

#include <cstddef>
#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/bytes.hpp>
#include <runtime/ray_triangle.hpp>

namespace espalier::detail {

/// Where the pieces of a node are.
struct Node {
    const std::byte* bytes;

    [[nodiscard]] std::uint32_t first_child() const { return load_u32(bytes + format::node::children_at) & 0xFFFFFFu; }
    [[nodiscard]] unsigned node_children() const { return load_u8(bytes + format::node::children_at + 3) & 15u; }
    [[nodiscard]] unsigned leaf_children() const { return load_u8(bytes + format::node::children_at + 3) >> 4; }
    [[nodiscard]] unsigned shift(int axis) const {
        return (load_u16(bytes + format::node::shifts_at) >> (5 * axis)) & 31u;
    }
    [[nodiscard]] std::int32_t base(int axis, unsigned bits) const {
        const unsigned unit = bits > 16 ? bits - 16 : 0;
        return static_cast<std::int32_t>(load_u16(bytes + format::node::base_at + 2 * static_cast<std::size_t>(axis))
                                         << unit);
    }
    [[nodiscard]] const std::byte* low_planes(int axis) const {
        return bytes + format::node::lo_at + 8 * static_cast<std::size_t>(axis);
    }
    [[nodiscard]] const std::byte* high_planes(int axis) const {
        return bytes + format::node::hi_at + 8 * static_cast<std::size_t>(axis);
    }
    [[nodiscard]] std::int32_t low(int axis, unsigned child, unsigned bits) const {
        return base(axis, bits) + static_cast<std::int32_t>(load_u8(low_planes(axis) + child) << shift(axis));
    }
    [[nodiscard]] std::int32_t high(int axis, unsigned child, unsigned bits) const {
        return base(axis, bits) + static_cast<std::int32_t>(load_u8(high_planes(axis) + child) << shift(axis));
    }
    [[nodiscard]] const std::byte* leaf_block(const BlobData& blob) const {
        return blob.leaves + 4 * std::size_t{load_u32(bytes + format::node::leaf_block_at)};
    }
};

inline Node node_at(const BlobData& blob, std::uint32_t index) {
    return {blob.nodes + std::size_t{index} * format::node::bytes};
}

/// One leaf: where its streams are and how wide their fields.
struct IndexedLeaf {
    Node node;               ///< whose child it is
    const std::byte* block;  ///< of the node's leaves
    const std::byte* coordinates[3];
    const std::byte* triangles;
    unsigned width[3];
    unsigned corner_width;
    unsigned vertex_count;
    unsigned triangle_count;
    unsigned number;  ///< among the node's leaves
    const BlobData* blob;
    std::uint32_t size;  ///< more than the distance of any two vertices along an axis

    /// One for each leaf of the node.
    [[nodiscard]] const std::byte* descriptors() const { return block + format::indexed_leaf::descriptors_at; }
    /// Among the children of its node.
    [[nodiscard]] unsigned child() const { return node.node_children() + number; }
    /// The low corner of its box, which the coordinates count from.
    [[nodiscard]] std::int32_t anchor(int axis) const { return node.low(axis, child(), blob->bits); }
    [[nodiscard]] LatticeTriangle triangle(unsigned index) const {
        const std::int32_t anchors[3] = {anchor(0), anchor(1), anchor(2)};
        std::uint32_t corners = load_field(triangles, 3 * corner_width, index);
        LatticeTriangle result;
        for (auto& corner : result.corner) {
            const unsigned vertex = corners & ((1u << corner_width) - 1u);
            corners >>= corner_width;
            for (int k = 0; k < 3; ++k)
                corner[k] = anchors[k] + static_cast<std::int32_t>(load_field(coordinates[k], width[k], vertex));
        }
        return result;
    }
};

/// The leaf that is child `node.node_children() + number` of the node.
inline IndexedLeaf indexed_leaf(const BlobData& blob, const Node& node, unsigned number) {
    using namespace format::indexed_leaf;
    IndexedLeaf leaf;
    leaf.node = node;
    leaf.block = node.leaf_block(blob);
    leaf.number = number;
    leaf.blob = &blob;
    const std::uint32_t descriptor = load_u32(leaf.block + descriptors_at + descriptor_bytes * std::size_t{number});
    leaf.triangle_count = ((descriptor >> triangles_shift) & 15u) + 1;
    leaf.vertex_count = ((descriptor >> vertices_shift) & 31u) + 1;
    leaf.corner_width = format::indexed_leaf::corner_width(leaf.vertex_count);
    const std::byte* at = leaf.block + descriptors_at + descriptor_bytes * std::size_t{node.leaf_children()} +
                          2 * std::size_t{descriptor & ((1u << offset_bits) - 1u)};
    unsigned longest = 0;
    for (int k = 0; k < 3; ++k) {
        leaf.width[k] =
            coordinate_width((descriptor >> (widths_shift + 4 * static_cast<unsigned>(k))) & 15u, blob.bits);
        leaf.coordinates[k] = at;
        at += stream_bytes(leaf.vertex_count, leaf.width[k]);
        longest = leaf.width[k] > longest ? leaf.width[k] : longest;
    }
    leaf.triangles = at;
    leaf.size = 1u << longest;
    return leaf;
}

/// Storage index of the first triangle of a leaf. All descriptors that there could be are read, the later ones masked
/// out (the guard keeps that inside the blob): how many come before is not to be foreseen, and a mistaken guess costs
/// more.
inline std::uint32_t first_triangle(const IndexedLeaf& leaf) {
    std::uint32_t first = load_u32(leaf.block);
    const std::byte* descriptor = leaf.descriptors();
    for (unsigned i = 0; i + 1 < format::max_children; ++i, descriptor += format::indexed_leaf::descriptor_bytes) {
        const std::uint32_t count = ((load_u32(descriptor) >> format::indexed_leaf::triangles_shift) & 15u) + 1;
        first += count & (i < leaf.number ? ~0u : 0u);
    }
    return first;
}

}  // namespace espalier::detail
