// A binary tree of any shape and height, from builders that do not go from the root down.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <baker/build/binary_tree.hpp>
#include <baker/build/sah_split.hpp>
#include <baker/build/settings.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// Nodes are numbered: leaf t is node t, inner node i is node i + leaves. The tree of n leaves has n - 1 inner nodes.
struct TreeShape {
    std::vector<std::array<std::uint32_t, 2>> children;  ///< of each inner node, left and right
    std::uint32_t root = 0;
};

/// The tree in the order of BinaryTree. Where it is higher than allowed, it stays as it is down to the last nodes whose
/// children leave room for balanced trees; what lies below those is built anew by build_sah_below. Leaf t is
/// references[t]; there is one at least.
[[nodiscard]] BinaryTree lay_out(std::span<const Reference> references, const TreeShape& shape,
                                 const BuildSettings& settings);

/// Lays out a tree in which leaf t is triangle t of the mesh.
[[nodiscard]] BinaryTree lay_out(const LatticeMesh& mesh, const TreeShape& shape, const BuildSettings& settings);

}  // namespace espalier::baker
