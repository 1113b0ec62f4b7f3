// What makes a binary tree: the builder of the options, or one from elsewhere.
#pragma once

#include <functional>

#include <baker/build/binary_tree.hpp>
#include <baker/build/settings.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// Returns a tree over the triangles of a mesh on its lattice, as `build` does.
using TreeMaker = std::function<BinaryTree(const LatticeMesh& mesh, const BuildSettings& settings)>;

}  // namespace espalier::baker
