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

/// The vertices of a triangle, by their numbers in its leaf.
struct LeafCorners {
    std::uint8_t vertex[3];

    constexpr LeafCorners(unsigned a, unsigned b, unsigned c)
        : vertex{static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(c)} {}
};

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
    [[nodiscard]] LatticeTriangle triangle_of(LeafCorners corners) const {
        LatticeTriangle triangle;
        for (int k = 0; k < 3; ++k) {
            const std::int32_t from = anchor(k);
            for (int corner = 0; corner < 3; ++corner)
                triangle.corner[corner][k] =
                    from + static_cast<std::int32_t>(load_field(coordinates[k], width[k], corners.vertex[corner]));
        }
        return triangle;
    }
    /// The anchor as seen from an origin, in whose units of 2^-fraction_bits steps it is answered, and
    ESPALIER_SHARED_CODE void place_anchor(const std::int32_t* origin, int fraction_bits, std::int32_t* place) const {
        for (int k = 0; k < 3; ++k) place[k] = (anchor(k) << fraction_bits) - origin[k];
    }
    /// a vertex, given that.
    ESPALIER_SHARED_CODE void place_vertex(unsigned vertex, const std::int32_t* placed_anchor, int fraction_bits,
                                           std::int32_t* place) const {
        for (int k = 0; k < 3; ++k) {
            const unsigned bit = width[k] * vertex;  // load_field, without a call for each coordinate
            const std::uint32_t field = load_u32(coordinates[k] + bit / 8) >> (bit % 8) & ((1u << width[k]) - 1u);
            place[k] = placed_anchor[k] + static_cast<std::int32_t>(field << fraction_bits);
        }
    }
};

}  // namespace espalier::detail
