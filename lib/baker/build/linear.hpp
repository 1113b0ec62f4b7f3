// A binary tree along a space-filling curve.
#pragma once

#include <baker/build/binary_tree.hpp>
#include <baker/build/settings.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// Splits where the highest bit of the Morton codes changes: "Fast BVH construction on GPUs" (Lauterbach, Garland,
/// Sengupta, Luebke, Manocha 2009). As `build`.
[[nodiscard]] BinaryTree build_linear(const LatticeMesh& mesh, const BuildSettings& settings);

}  // namespace espalier::baker
