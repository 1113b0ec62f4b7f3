// The tree of a mesh that moves: the one that costs least over all poses.
#pragma once

#include <span>
#include <vector>

#include <baker/build/build.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// Builds a tree for the mesh, one for each pose, and one over all of them at once. Returns the one with the least sum
/// of costs over the mesh and the poses, with the boxes of the mesh; of equal ones the first. The cost of a tree in a
/// pose is the area of all boxes over that of the root's, as in "T-SAH: animation optimized bounding volume
/// hierarchies" (Bittner, Meister 2015). A pose has a point for each vertex of the mesh.
[[nodiscard]] BinaryTree make_steered_tree(const TreeMaker& make_tree, const LatticeMesh& mesh,
                                           std::span<const std::vector<LatticePoint>> poses,
                                           const BuildSettings& settings);

}  // namespace espalier::baker
