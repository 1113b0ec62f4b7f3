// A binary tree in which large triangles are in several leaves, each with the part of them that it needs.
#pragma once

#include <baker/build/binary_tree.hpp>
#include <baker/build/settings.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// "Spatial splits in bounding volume hierarchies" (Stich, Friedrich, Dietrich 2009), with at most
/// settings.duplicate_budget * triangles references more than there are triangles. BinaryTree::triangles names a
/// triangle as often as it has references; their boxes together hold all of it (clip_triangle.hpp). One thread. As
/// `build`.
[[nodiscard]] BinaryTree build_spatial(const LatticeMesh& mesh, const BuildSettings& settings);

}  // namespace espalier::baker
