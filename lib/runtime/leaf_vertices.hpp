// What all kinds of leaves share: vertices as bit-packed streams, one for each axis.
#pragma once

#include <cstddef>
#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/bytes.hpp>
#include <runtime/codec_node.hpp>
#include <runtime/lattice_ray.hpp>
#include <runtime/lattice_triangle.hpp>
#include <runtime/small_code.hpp>

namespace espalier::detail {

/// The leaf of a kind that is child `node.node_children() + number` of the node.
template <class Leaf>
Leaf leaf_at(const BlobData& blob, Node node, unsigned number);

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
#if ESPALIER_SMALL_CODE
    std::int32_t kept_anchor[3];
#endif
    std::uint8_t width[3];
    std::uint8_t vertex_count;
    std::uint8_t number;     ///< among the node's leaves
    std::uint8_t size_bits;  ///< of a number that is more than the distance of any two vertices along an axis

    /// Among the children of its node.
    [[nodiscard]] unsigned child() const { return node.node_children() + number; }
    /// Whether an axis counts from 0: vertices outside of the leaf's box, as copies have them.
    [[nodiscard]] bool counts_from_zero(int axis) const {
        // mutant(without 1) equivalent: open refuses strips with copies; this only saves strips the test
        return may_have_copies && (blob->features & format::feature::split_references) != 0 &&
               width[axis] == blob->bits;
    }
    /// What the coordinates count from: the low corner of its box, most often.
    [[nodiscard]] std::int32_t anchor(int axis) const {
#if ESPALIER_SMALL_CODE
        return kept_anchor[axis];
#else
        return find_anchor(axis);
#endif
    }
    /// Once the width is there. Small code has it in one place, and keeps it.
    void keep_anchor([[maybe_unused]] int axis) {
#if ESPALIER_SMALL_CODE
        kept_anchor[axis] = find_anchor(axis);
#endif
    }
    [[nodiscard]] std::int32_t find_anchor(int axis) const {
        return counts_from_zero(axis) ? 0 : node.plane(axis, node.low_planes(axis) + child(), blob->bits);
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
    /// A vertex as seen from the ray's origin, in the ray's units.
    ESPALIER_SHARED_CODE void place_vertex(unsigned vertex, const IntegerRay& ray, std::int32_t* place) const {
        for (int k = 0; k < 3; ++k) {
            const unsigned bit = width[k] * vertex;  // load_field, without a call for each coordinate
            const std::uint32_t field = load_u32(coordinates[k] + bit / 8) >> (bit % 8) & ((1u << width[k]) - 1u);
            place[k] = ((anchor(k) + static_cast<std::int32_t>(field)) << ray.fraction_bits) - ray.origin[k];
        }
    }
};

}  // namespace espalier::detail
