// What all kinds of leaves share: vertices as bit-packed streams, one for each axis.
#pragma once

#include <cstddef>
#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/bytes.hpp>
#include <runtime/codec_node.hpp>
#include <runtime/ray_triangle.hpp>
#include <runtime/small_code.hpp>

namespace espalier::detail {

/// The leaf of a kind that is child `node.node_children() + number` of the node.
template <class Leaf>
Leaf leaf_at(const BlobData& blob, const Node& node, unsigned number);

/// `holds_copies`: whether blobs with such leaves may have copies of triangles (docs/format.md, `copies`).
template <bool holds_copies>
struct LeafVertices {
    static constexpr bool may_have_copies = holds_copies;

    Node node;               ///< whose child the leaf is
    const std::byte* block;  ///< of the node's leaves
    const BlobData* blob;
    const std::byte* coordinates[3];
    std::uint32_t size;  ///< more than the distance of any two vertices along an axis
    std::uint8_t width[3];
    std::uint8_t vertex_count;
    std::uint8_t number;  ///< among the node's leaves

    /// Among the children of its node.
    [[nodiscard]] unsigned child() const { return node.node_children() + number; }
    /// Whether an axis counts from 0: vertices outside of the leaf's box, as copies have them.
    [[nodiscard]] bool counts_from_zero(int axis) const {
        return may_have_copies && (blob->features & format::feature::split_references) != 0 &&
               width[axis] == blob->bits;
    }
    /// What the coordinates count from: the low corner of its box, most often.
    [[nodiscard]] ESPALIER_SHARED_CODE std::int32_t anchor(int axis) const {
        return counts_from_zero(axis) ? 0 : node.low(axis, child(), blob->bits);
    }
    [[nodiscard]] LatticeTriangle triangle_of(unsigned a, unsigned b, unsigned c) const {
        const unsigned vertices[3] = {a, b, c};
        LatticeTriangle triangle;
        for (int k = 0; k < 3; ++k) {
            const std::int32_t from = anchor(k);
            for (int corner = 0; corner < 3; ++corner)
                triangle.corner[corner][k] =
                    from + static_cast<std::int32_t>(load_field(coordinates[k], width[k], vertices[corner]));
        }
        return triangle;
    }
};

}  // namespace espalier::detail
