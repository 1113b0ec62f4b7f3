// The leaves of profile `fast`: coordinates and vertex numbers in whole bytes, which lanes load as they are. The layout
// is in format/leaves.hpp. What comes out is integers on the lattice: triangles as corners.
#pragma once

#include <runtime/blob/deformable_blob.hpp>
#include <runtime/blob/node.hpp>

namespace espalier::detail {

/// One leaf: where its rows of bytes are. Its slots are its triangles.
struct PlainLeaf : LeafVertices<PlainNode> {
    using Slots = std::uint32_t;  ///< a bit for each slot
    static constexpr unsigned max_vertices = format::plain_leaf::max_vertices;
    static constexpr unsigned max_slots = format::plain_leaf::max_triangles;
    static constexpr bool may_have_duplicates = true;
    static constexpr bool counts_from_zero = true;

    std::uint8_t slot_count;
    const std::byte* data;
    const std::byte* corner_row;  ///< the first corner of each triangle; the second and the third follow

    [[nodiscard]] Slots used_slots() const { return (1u << slot_count) - 1u; }
    [[nodiscard]] unsigned triangle_count() const { return slot_count; }
    /// The storage index of its first triangle.
    // mutant(+ -> -, + -> right side dropped) equivalent: first_at is 0
    [[nodiscard]] std::uint32_t first() const { return load_u32(data + format::plain_leaf::first_at); }
    /// The low 16 bits of each coordinate, axis by axis.
    [[nodiscard]] const std::byte* words() const { return data + format::plain_leaf::words_at; }
    /// Whether coordinates have more than the words.
    [[nodiscard]] bool has_high_bytes() const { return format::plain_leaf::has_high_bytes(blob->bits); }
    /// Bits 16 to 23 of each coordinate, axis by axis.
    [[nodiscard]] const std::byte* high_bytes() const {
        const unsigned corners = is_deformable(*blob) ? 0 : 3u * slot_count;  // those of deformable blobs lie apart
        return words() + (6u * vertex_count + corners);
    }

    static constexpr std::int32_t anchor(int) { return 0; }
    [[nodiscard]] ESPALIER_ALWAYS_INLINE std::int32_t offset(int axis, unsigned vertex) const {
        const std::size_t place = static_cast<std::size_t>(axis) * vertex_count + vertex;
        const std::uint32_t low = load_u16(words() + 2 * place);
        return static_cast<std::int32_t>(has_high_bytes() ? low | load_u8(high_bytes() + place) << 16 : low);
    }
    /// Every coordinate lies less than 2^(grid_bits() - 1) from it, either way.
    [[nodiscard]] std::int32_t grid_base(int axis) const { return offset(axis, 0); }
    [[nodiscard]] int grid_bits() const { return size_bits + 1; }

    /// The vertex that is a triangle's corner 0, 1 or 2.
    [[nodiscard]] unsigned corner(unsigned slot, unsigned which) const {
        return load_u8(corner_row + which * slot_count + slot);
    }
    [[nodiscard]] LeafCorners corners(unsigned slot) const {
        return {corner(slot, 0), corner(slot, 1), corner(slot, 2)};
    }
    [[nodiscard]] ESPALIER_SHARED_CODE LatticeTriangle triangle(unsigned slot) const {
        return small_code ? triangle_by_corners(slot) : triangle_of(*this, corners(slot));
    }

private:
    /// Places of rows are computed once, not for each coordinate.
    [[nodiscard]] LatticeTriangle triangle_by_corners(unsigned slot) const {
        LatticeTriangle triangle;
        const std::size_t row_bytes = std::size_t{2} * vertex_count;
        const std::byte* row = corner_row + slot;
        for (auto& corner : triangle.corner) {
            const std::byte* const at = words() + 2 * std::size_t{load_u8(row)};
            corner[0] = static_cast<std::int32_t>(load_u16(at));
            corner[1] = static_cast<std::int32_t>(load_u16(at + row_bytes));
            corner[2] = static_cast<std::int32_t>(load_u16(at + 2 * row_bytes));
            row += slot_count;
        }
        if (has_high_bytes()) add_high_bytes(slot, triangle);
        return triangle;
    }
    void add_high_bytes(unsigned slot, LatticeTriangle& triangle) const {
        for (unsigned i = 0; i < 3; ++i) {
            const std::byte* at = high_bytes() + corner(slot, i);
            for (std::int32_t& coordinate : triangle.corner[i]) {
                coordinate |= static_cast<std::int32_t>(load_u8(at) << 16);
                at += vertex_count;
            }
        }
    }
};

/// The leaf that is child `node.node_children() + number` of the node.
ESPALIER_SHARED_OR_PART_OF_CALLER inline void decode_leaf(const BlobData& blob, PlainNode node, unsigned number,
                                                          PlainLeaf& leaf) {
    using namespace format::plain_leaf;
    leaf.node = node;
    leaf.number = static_cast<std::uint8_t>(number);
    leaf.blob = &blob;
    const std::uint32_t descriptor = node.leaf_descriptor(number);
    const std::byte* const data = node.leaf_block(blob) + 4 * std::size_t{descriptor & ((1u << offset_bits) - 1u)};
    leaf.slot_count = static_cast<std::uint8_t>((descriptor >> triangles_shift & 15u) + 1);
    leaf.vertex_count = static_cast<std::uint8_t>((descriptor >> vertices_shift & 31u) + 1);
    leaf.size_bits = static_cast<std::uint8_t>((descriptor >> size_shift & 15u) + least_size(blob.bits));
    leaf.data = data;
    leaf.corner_row = is_deformable(blob) ? blob.corners + format::corners::triangle_bytes * std::size_t{leaf.first()}
                                          : leaf.words() + std::size_t{6} * leaf.vertex_count;
}

}  // namespace espalier::detail
