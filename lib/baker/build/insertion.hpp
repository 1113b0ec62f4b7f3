// A binary tree into which one triangle after the other is put.
#pragma once

#include <baker/build/binary_tree.hpp>
#include <baker/build/settings.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// "Automatic creation of object hierarchies for ray tracing" (Goldsmith, Salmon 1987), in shuffled order as they
/// advise; the place is searched as in "Incremental BVH construction for ray tracing" (Bittner, Hapala, Havran 2015),
/// and on the way back up children and grandchildren change places as in "Fast, effective BVH updates for animated
/// scenes" (Kopta et al. 2012). One thread. As `build`.
[[nodiscard]] BinaryTree build_insertion(const LatticeMesh& mesh, const BuildSettings& settings);

}  // namespace espalier::baker
