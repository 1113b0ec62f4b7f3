// A binary tree of any shape and height, from builders that do not go from the root down.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "binary_tree.hpp"
#include "build_settings.hpp"
#include "lattice_mesh.hpp"

namespace espalier::baker {

/// Nodes are numbered: triangle t of the mesh is node t, inner node i is node i + triangles. The tree of n triangles
/// has n - 1 inner nodes.
struct TreeShape {
    std::vector<std::array<std::uint32_t, 2>> children;  ///< of each inner node, left and right
    std::uint32_t root = 0;
};

/// The tree in the order of BinaryTree. Where it is higher than allowed, it stays as it is down to the last nodes whose
/// children leave room for balanced trees; what lies below those is built anew by build_sah_below.
[[nodiscard]] BinaryTree lay_out(const LatticeMesh& mesh, const TreeShape& shape, const BuildSettings& settings);

}  // namespace espalier::baker
