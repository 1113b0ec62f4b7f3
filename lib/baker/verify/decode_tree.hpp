// The baker's own reader of trees and leaves, written from docs/format.md and shared with nothing that writes or
// queries, so that it can testify to both. Reads nothing outside its sections: what would lie there reads as failure.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <espalier/format.hpp>

namespace espalier::baker {

using Coordinates = std::array<std::int32_t, 3>;

struct DecodedBox {
    Coordinates lo{};
    Coordinates hi{};
    [[nodiscard]] bool contains(const DecodedBox& other) const;
    void add(const DecodedBox& other);
    [[nodiscard]] DecodedBox intersection(const DecodedBox& other) const;  ///< lo above hi where there is none
};

struct DecodedNode {
    std::uint32_t first_child = 0;
    std::uint32_t leaf_block = 0;  ///< in bytes
    unsigned node_children = 0;
    unsigned leaves = 0;
    std::array<DecodedBox, format::max_children> boxes{};
    std::array<std::uint32_t, format::max_children>
        descriptors{};  ///< of its plain leaves; those of strips are in the block

    [[nodiscard]] unsigned children() const { return node_children + leaves; }
};

struct DecodedLeaf {
    std::size_t at = 0;                ///< of its data, in the leaf section
    std::size_t bytes = 0;             ///< of its data
    std::uint32_t first_triangle = 0;  ///< storage index
    unsigned vertex_count = 0;
    unsigned triangle_count = 0;
    std::array<Coordinates, format::max_leaf_vertices> vertices{};
    std::array<std::array<std::uint32_t, 3>, format::max_leaf_triangles> corners{};

    [[nodiscard]] DecodedBox box() const;
};

/// The sections of a blob that hold its tree.
struct TreeBytes {
    std::span<const std::byte> nodes;
    std::span<const std::byte> leaves;
    unsigned bits = 1;
    Profile profile = Profile::fast;
    bool has_copies = false;  ///< the blob has split references
    Coordinates extent{};
    /// The section of corners of a deformable blob, whose boxes are the least that hold their vertices.
    std::optional<std::span<const std::byte>> corners = std::nullopt;

    /// Node `number`; false when there is none or when it has more children than its profile allows.
    [[nodiscard]] bool decode_node(std::uint32_t number, DecodedNode& node) const;

    /// Leaf `index` of a node; false when any of it lies outside, or a corner is no vertex.
    [[nodiscard]] bool decode_leaf(const DecodedNode& node, unsigned index, DecodedLeaf& leaf) const;

    /// Where the data of a node's first leaf belongs.
    [[nodiscard]] std::size_t first_leaf_at(const DecodedNode& node) const;
    /// Leaves lie one after the other at multiples of this.
    [[nodiscard]] std::size_t leaf_unit() const { return profile == Profile::fast ? 4 : 1; }

private:
    [[nodiscard]] bool decode_plain_node(std::span<const std::byte> bytes, DecodedNode& node) const;
    [[nodiscard]] bool decode_packed_node(std::span<const std::byte> bytes, DecodedNode& node) const;
    [[nodiscard]] bool decode_plain_leaf(const DecodedNode& node, unsigned index, DecodedLeaf& leaf) const;
    [[nodiscard]] bool decode_strip_leaf(const DecodedNode& node, unsigned index, DecodedLeaf& leaf) const;
    [[nodiscard]] bool decode_predicted_strip(const DecodedNode& node, unsigned index, DecodedLeaf& leaf) const;
};

}  // namespace espalier::baker
