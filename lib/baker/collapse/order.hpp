// Fifth stage: the one order that the format allows, for nodes, slots, leaves and triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <espalier/format.hpp>

#include <baker/build/binary_tree.hpp>
#include <baker/collapse/collapse.hpp>
#include <baker/collapse/strip.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

struct WideNode {
    std::array<std::uint32_t, format::max_children> binary_nodes{};  ///< of each child: its box
    std::uint32_t first_child = 0;                                   ///< 0 without node children
    std::uint32_t first_leaf = 0;                                    ///< into WideTree::leaves
    std::uint8_t node_children = 0;                                  ///< they take the first slots
    std::uint8_t leaves = 0;
};

struct Leaf {
    std::uint32_t first = 0;  ///< storage index of its first triangle
    std::uint32_t count = 0;
    std::uint32_t binary_node = 0;  ///< its box
};

struct WideTree {
    std::vector<WideNode> nodes;              ///< as they are stored
    std::vector<Leaf> leaves;                 ///< as they are stored
    std::vector<std::uint32_t> triangles;     ///< by storage index: number into LatticeMesh::triangles
    std::vector<Strip> strips;                ///< of each leaf, in profiles that have them
    std::vector<std::uint8_t> first_corners;  ///< by storage index: which corner of the mesh's triangle comes first
    std::uint32_t copies = 0;                 ///< storage indices whose triangle has a lower one
    unsigned depth = 0;                       ///< nodes on the longest way down
};

/// Node children stand before leaves, larger boxes before smaller ones, of equal ones the one with the lower triangle
/// number first. The node children of a node get the next free numbers, and its leaves the next place in the leaf
/// section, when a walk in depth-first order comes to the node. Triangles of a leaf keep the order of the source, or
/// without `strips` being null that of their strip.
[[nodiscard]] WideTree put_in_order(const LatticeMesh& mesh, const BinaryTree& tree, const CollapsePlan& plan,
                                    const StripMaker* strips);

}  // namespace espalier::baker
