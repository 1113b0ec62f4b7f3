// Binary trees of oriented boxes and of axis-aligned ones, on one topology.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "../traversal/aabb_tree.hpp"
#include "../volumes/stored.hpp"
#include "../volumes/trees.hpp"

namespace espalier::bench {

/// Numbers of a tree's triangles: those of a node follow one another.
struct TriangleRange {
    std::size_t first;
    std::size_t end;
};
/// Returns one for each node.
[[nodiscard]] std::vector<TriangleRange> triangle_ranges(const AabbTree& tree);

/// Nodes with a box of one kind, in the order of the tree that they belong to.
template <class Stored>
using BoxNodes = std::vector<VolumeNode<Stored>>;

/// A tree whose topology follows from oriented boxes, and these.
struct ObbTree {
    AabbTree tree;
    BoxNodes<StoredObb> boxes;
};

/// Builds from the top down (Gottschalk, Lin, Manocha 1996), one triangle in each leaf: a box is fitted by
/// BoxFit::hull, and a plane across its longest axis divides the triangles by the side of their centers; it goes
/// through the mean of the vertices. Where all are on one side, the next axis is taken, and at last a half of them.
[[nodiscard]] ObbTree build_obb_tree(std::span<const FloatTriangle> triangles);

/// Fits oriented boxes to the nodes of a tree, as build_obb_tree does.
[[nodiscard]] BoxNodes<StoredObb> fit_obbs(const AabbTree& tree);
/// Copies the boxes of a tree.
[[nodiscard]] BoxNodes<StoredAabb> copy_aabbs(const AabbTree& tree);

}  // namespace espalier::bench
