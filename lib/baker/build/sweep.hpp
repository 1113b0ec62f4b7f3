// A binary tree by the surface area heuristic over every split of the sorted triangles.
#pragma once

#include <baker/build/binary_tree.hpp>
#include <baker/build/settings.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// Sorts once along every axis and keeps the orders while splitting, O(n log n): "Heuristics for ray tracing using
/// space subdivision" (MacDonald, Booth 1990), as a full sweep in "Ray tracing deformable scenes using dynamic bounding
/// volume hierarchies" (Wald, Boulos, Shirley 2007). As `build`.
[[nodiscard]] BinaryTree build_sweep(const LatticeMesh& mesh, const BuildSettings& settings);

}  // namespace espalier::baker
