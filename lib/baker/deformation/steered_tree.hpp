// The tree of a mesh that moves: of those for each pose the one that costs least over all of them.
#pragma once

#include <span>
#include <vector>

#include <baker/build/tree_maker.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// Builds a tree for the mesh and for each pose, and returns the one with the least sum of costs over all of them, with
/// the boxes of the mesh. The cost of a tree in a pose is the area of all boxes over that of the root's, as in "T-SAH:
/// animation optimized bounding volume hierarchies" (Bittner, Meister 2015). Of equal ones it is that of the first
/// pose, after the mesh itself. A pose has a point for each vertex of the mesh.
[[nodiscard]] BinaryTree make_steered_tree(const TreeMaker& make_tree, const LatticeMesh& mesh,
                                           std::span<const std::vector<LatticePoint>> poses,
                                           const BuildSettings& settings);

}  // namespace espalier::baker
