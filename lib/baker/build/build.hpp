// Third stage: a binary tree over the triangles, by the builder of the options.
#pragma once

#include <functional>

#include <espalier/bake.hpp>

#include <baker/build/binary_tree.hpp>
#include <baker/build/settings.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// Returns a tree over the triangles of a mesh on its lattice, as `build` does.
using TreeMaker = std::function<BinaryTree(const LatticeMesh& mesh, const BuildSettings& settings)>;

/// Down to single triangles, at most most_height high, or as high as a balanced tree must be. The result depends on
/// the triangles, the builder and the settings, but not on threads.
[[nodiscard]] BinaryTree build(const LatticeMesh& mesh, Builder builder, const BuildSettings& settings);

}  // namespace espalier::baker
