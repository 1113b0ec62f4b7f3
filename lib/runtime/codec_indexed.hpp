// The leaves of profile `fast`, decoded: bit-packed streams of vertices and of triangles. The layout is in format.hpp.
// What comes out is integers on the lattice: triangles as corners.
#pragma once

#include <cstddef>
#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/bytes.hpp>
#include <runtime/leaf_vertices.hpp>

namespace espalier::detail {

/// One leaf: where its streams are and how wide their fields. Its slots are its triangles.
struct IndexedLeaf : LeafVertices<true> {
    using Slots = std::uint32_t;  ///< a bit for each slot
    static constexpr unsigned max_vertices = format::indexed_leaf::max_vertices;
    static constexpr unsigned max_slots = format::indexed_leaf::max_triangles;

    std::uint8_t corner_width;
    std::uint8_t slot_count;
    const std::byte* triangles;

    [[nodiscard]] Slots used_slots() const { return (1u << slot_count) - 1u; }
    [[nodiscard]] unsigned triangle_count() const { return slot_count; }
    /// One for each leaf of the node.
    [[nodiscard]] const std::byte* descriptors() const { return block + format::indexed_leaf::descriptors_at; }
    /// The vertex that is a triangle's corner 0, 1 or 2.
    [[nodiscard]] unsigned corner(unsigned slot, unsigned which) const {
        return load_field(triangles, corner_width, 3 * slot + which);
    }
    [[nodiscard]] LeafCorners corners(unsigned slot) const {
        const std::uint32_t packed = load_field(triangles, 3 * corner_width, slot);
        const std::uint32_t mask = (1u << corner_width) - 1u;
        return {packed & mask, packed >> corner_width & mask, packed >> (2 * corner_width) & mask};
    }
    [[nodiscard]] ESPALIER_SHARED_CODE LatticeTriangle triangle(unsigned slot) const {
        return triangle_of(corners(slot));
    }
};

/// The leaf that is child `node.node_children() + number` of the node.
ESPALIER_SHARED_CODE inline IndexedLeaf indexed_leaf(const BlobData& blob, Node node, unsigned number) {
    using namespace format::indexed_leaf;
    IndexedLeaf leaf;
    leaf.node = node;
    leaf.block = node.leaf_block(blob);
    leaf.number = static_cast<std::uint8_t>(number);
    leaf.blob = &blob;
    const std::uint32_t descriptor = load_u32(leaf.block + descriptors_at + descriptor_bytes * std::size_t{number});
    leaf.slot_count = static_cast<std::uint8_t>(((descriptor >> triangles_shift) & 15u) + 1);
    leaf.vertex_count = static_cast<std::uint8_t>(((descriptor >> vertices_shift) & 31u) + 1);
    leaf.corner_width = static_cast<std::uint8_t>(format::indexed_leaf::corner_width(leaf.vertex_count));
    const std::byte* at = leaf.block + descriptors_at + descriptor_bytes * std::size_t{node.leaf_children()} +
                          2 * std::size_t{descriptor & ((1u << offset_bits) - 1u)};
    unsigned longest = 0;
    for (int k = 0; k < 3; ++k) {
        const unsigned width =
            coordinate_width((descriptor >> (widths_shift + 4 * static_cast<unsigned>(k))) & 15u, blob.bits);
        leaf.width[k] = static_cast<std::uint8_t>(width);
        leaf.coordinates[k] = at;
        leaf.keep_anchor(k);
        at += stream_bytes(leaf.vertex_count, width);
        // mutant(> -> >=) equivalent: both sides are equal then
        longest = width > longest ? width : longest;
    }
    leaf.triangles = at;
    leaf.size_bits = static_cast<std::uint8_t>(longest);
    return leaf;
}

template <>
inline IndexedLeaf leaf_at(const BlobData& blob, Node node, unsigned number) {
    return indexed_leaf(blob, node, number);
}

/// Storage index of the leaf's first triangle. All descriptors that there could be are read, the later ones masked
/// out (the guard keeps that inside the blob): how many come before is not to be foreseen, and a mistaken guess costs
/// more.
ESPALIER_SHARED_CODE inline std::uint32_t first_triangle(const IndexedLeaf& leaf) {
    std::uint32_t first = load_u32(leaf.block);
    const std::byte* descriptor = leaf.descriptors();
    constexpr unsigned most = format::max_children - 1;
    const unsigned end = small_code ? leaf.number : most;
    // mutant(< -> <=) equivalent: reads one more descriptor, from the guard at the latest, and masks it out
    for (unsigned i = 0; i < end; ++i, descriptor += format::indexed_leaf::descriptor_bytes) {
        const std::uint32_t count = ((load_u32(descriptor) >> format::indexed_leaf::triangles_shift) & 15u) + 1;
        first += count & (i < leaf.number ? ~0u : 0u);
    }
    return first;
}

}  // namespace espalier::detail
