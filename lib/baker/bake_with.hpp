// Variants of espalier::bake: with a tree from elsewhere, for benchmarks and tests, and for trials.
#pragma once

#include <functional>

#include <espalier/bake.hpp>

#include <baker/build/binary_tree.hpp>
#include <baker/build/settings.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// Called once, with the mesh on its lattice; answers with a tree as `build` gives it.
using TreeMaker = std::function<BinaryTree(const LatticeMesh& mesh, const BuildSettings& settings)>;

[[nodiscard]] Result<Baked, BakeError> bake_with(const TreeMaker& make_tree, std::span<const MeshView> meshes,
                                                 const BakeOptions& options);

/// Bakes the same blob as espalier::bake, but leaves out BakeReport::lost_closed and bits_that_keep_closed, which may
/// take as long as the bake: for one of several bakes of which only the best is made again and kept.
[[nodiscard]] Result<Baked, BakeError> bake_trial(std::span<const MeshView> meshes, const BakeOptions& options);

}  // namespace espalier::baker
