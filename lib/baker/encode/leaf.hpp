// The bytes of one leaf, in a file for each kind.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <baker/collapse/order.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// The leaf's box as its node has it, in lattice steps.
struct LeafBox {
    std::array<std::int32_t, 3> anchor;  ///< its low corner
    std::array<std::int32_t, 3> side;
};

/// The block of a node's strips, as far as it is written.
struct StripBlock {
    std::size_t data;              ///< where the data of its first leaf begins
    std::uint32_t first_triangle;  ///< storage index
};

/// The vertices of a plain leaf, as numbers into LatticeMesh::vertices, and its three rows of corners.
struct PlainLeafRows {
    std::vector<std::uint32_t> vertices;
    std::vector<std::uint8_t> corners;
};
[[nodiscard]] PlainLeafRows rows_of_plain_leaf(const LatticeMesh& mesh, const WideTree& wide, std::uint32_t number);

/// Append the data of leaf `number` of the wide tree; return its descriptor.
[[nodiscard]] std::uint32_t put_plain_leaf(const LatticeMesh& mesh, const WideTree& wide, std::uint32_t number,
                                           std::size_t block, std::vector<std::byte>& bytes);
[[nodiscard]] std::uint32_t put_strip_leaf(const LatticeMesh& mesh, const WideTree& wide, std::uint32_t number,
                                           const LeafBox& box, const StripBlock& block, std::vector<std::byte>& bytes);

[[nodiscard]] std::uint32_t put_predicted_strip(const LatticeMesh& mesh, const WideTree& wide, std::uint32_t number,
                                                const LeafBox& box, std::vector<std::byte>& bytes);

}  // namespace espalier::baker
