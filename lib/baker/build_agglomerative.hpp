// A binary tree from the triangles up: near clusters are joined.
#pragma once

#include "binary_tree.hpp"
#include "build_settings.hpp"
#include "lattice_mesh.hpp"

namespace espalier::baker {

/// "Efficient BVH construction via approximate agglomerative clustering" (Gu, He, Fatahalian, Blelloch 2013): the
/// triangles are parted along a space-filling curve, and every part hands a few clusters up. As `build`.
[[nodiscard]] BinaryTree build_agglomerative(const LatticeMesh& mesh, const BuildSettings& settings);

}  // namespace espalier::baker
