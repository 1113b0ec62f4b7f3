// Variants of espalier::bake: with a tree and costs from elsewhere, for benchmarks and tests, and for trials.
#pragma once

#include <espalier/bake.hpp>

#include <baker/build/build.hpp>
#include <baker/collapse/collapse.hpp>

namespace espalier::baker {

/// Bakes with the tree that `make_tree` returns, in place of BuildOptions::builder and the moves of subtrees. It is
/// called once, and once more for each pose of a deformable blob.
BakeResult bake_with(const TreeMaker& make_tree, std::span<const MeshView> meshes, const BakeOptions& options,
                     const RayCosts& costs = {});

/// Bakes the same blob as espalier::bake, but never warns of lost_closed, since that test may take as long as the bake:
/// for one of several bakes of which only the best is made again and kept.
BakeResult bake_trial(std::span<const MeshView> meshes, const BakeOptions& options);

}  // namespace espalier::baker
