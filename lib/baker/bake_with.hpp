// Variants of espalier::bake: with a tree and costs from elsewhere, for benchmarks and tests, and for trials.
#pragma once

#include <functional>

#include <espalier/bake.hpp>

#include <baker/build/binary_tree.hpp>
#include <baker/build/settings.hpp>
#include <baker/collapse/collapse.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// Called once, with the mesh on its lattice; returns a tree as `build` does.
using TreeMaker = std::function<BinaryTree(const LatticeMesh& mesh, const BuildSettings& settings)>;

/// Bakes with the tree that `make_tree` returns, in place of BuildOptions::builder and the moves of subtrees.
BakeResult bake_with(const TreeMaker& make_tree, std::span<const MeshView> meshes, const BakeOptions& options,
                     const RayCosts& costs = {});

/// Bakes the same blob as espalier::bake, but never warns of lost_closed, since that test may take as long as the bake:
/// for one of several bakes of which only the best is made again and kept.
BakeResult bake_trial(std::span<const MeshView> meshes, const BakeOptions& options);

}  // namespace espalier::baker
