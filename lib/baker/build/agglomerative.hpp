// A binary tree from the triangles up: near clusters are joined.
#pragma once

#include <baker/build/binary_tree.hpp>
#include <baker/build/settings.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// "Efficient BVH construction via approximate agglomerative clustering" (Gu, He, Fatahalian, Blelloch 2013): the
/// triangles are parted along a space-filling curve, and every part hands a few clusters up. As `build`.
[[nodiscard]] BinaryTree build_agglomerative(const LatticeMesh& mesh, const BuildSettings& settings);

}  // namespace espalier::baker
