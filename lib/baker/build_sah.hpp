// A binary tree by the surface area heuristic over planes between bins: fast to build and close to the best.
#pragma once

#include <cstdint>
#include <span>

#include "binary_tree.hpp"
#include "build_settings.hpp"
#include "lattice_mesh.hpp"
#include "sah_split.hpp"

namespace espalier::baker {

/// "On fast construction of SAH-based bounding volume hierarchies" (Wald 2007), down to single triangles. As `build`.
[[nodiscard]] BinaryTree build_sah(const LatticeMesh& mesh, const BuildSettings& settings);

/// The same for the subtree at `depth` over `count` references from `first` on, which it reorders; its nodes go to
/// `nodes`, their root first. Of `settings`, threads and progress count for nothing.
void build_sah_below(std::span<Reference> references, std::uint32_t first, std::uint32_t count, unsigned depth,
                     BinaryNode* nodes, const BuildSettings& settings);

}  // namespace espalier::baker
