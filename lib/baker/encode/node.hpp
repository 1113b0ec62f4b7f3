// The bytes of one node and of its leaves, in a file for each kind of node.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <espalier/format.hpp>

#include <baker/collapse/order.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// The box of one child, in lattice steps.
struct ChildBox {
    std::array<std::int32_t, 3> lo;
    std::array<std::int32_t, 3> hi;
};

/// A node and the boxes of its children.
struct NodeToWrite {
    const LatticeMesh& mesh;
    const WideTree& wide;
    const WideNode& node;
    Profile profile;
    std::span<const ChildBox> boxes;
};

/// Writes the frame and the planes of a packed node into its zeroed `bytes`.
void put_packed_boxes(std::span<const ChildBox> boxes, unsigned bits, std::byte* bytes);

/// Write into the node's zeroed `bytes`, and append its leaves to the leaf section.
void put_packed_node(const NodeToWrite& from, std::byte* bytes, std::vector<std::byte>& leaves);
void put_plain_node(const NodeToWrite& from, std::byte* bytes, std::vector<std::byte>& leaves);

}  // namespace espalier::baker
