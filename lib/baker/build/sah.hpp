// A binary tree by the surface area heuristic over planes between bins: fast to build and close to the best.
#pragma once

#include <cstdint>
#include <span>

#include <baker/build/binary_tree.hpp>
#include <baker/build/sah_split.hpp>
#include <baker/build/settings.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// "On fast construction of SAH-based bounding volume hierarchies" (Wald 2007), down to single triangles. As `build`.
[[nodiscard]] BinaryTree build_sah(const LatticeMesh& mesh, const BuildSettings& settings);

/// Builds the subtree at `depth` over `count` references from `first` on, which it reorders; its nodes go to `nodes`,
/// their root first. Ignores threads and progress in `settings`.
void build_sah_below(std::span<Reference> references, std::uint32_t first, std::uint32_t count, unsigned depth,
                     BinaryNode* nodes, const BuildSettings& settings);

}  // namespace espalier::baker
