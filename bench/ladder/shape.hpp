// The shape of a tree: which triangles are in which node. Every layout of the ladder is made from one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <baker/build/binary_tree.hpp>

#include "../deformation/box_tree.hpp"

namespace espalier::bench {

struct ShapeNode {
    std::uint32_t parent;       ///< of the root: 0
    std::uint32_t first_child;  ///< the others follow it
    std::uint32_t child_count;  ///< 0: a leaf
    std::uint32_t first;        ///< of the triangles below
    std::uint32_t count;

    [[nodiscard]] bool is_leaf() const { return child_count == 0; }
};

struct TreeShape {
    std::vector<ShapeNode> nodes;  ///< the root is the first; children come after their parents
    unsigned degree = 2;           ///< children of a node, at most
    unsigned height = 0;           ///< levels below the root

    [[nodiscard]] std::size_t inner_count() const;
};

/// Returns the shape of a binary tree that ends at leaves of `most_leaf_triangles`. Triangles are in the tree's order.
[[nodiscard]] TreeShape binary_shape(const baker::BinaryTree& tree, unsigned most_leaf_triangles);

/// Returns the shape with up to `degree` children a node that has the leaves of a binary shape. Of all such shapes
/// whose nodes are among those of the binary one, it has the least sum of the areas of inner nodes: the fewest expected
/// visits (dynamic programming of "Efficient incoherent ray traversal on GPUs through compressed wide BVHs", Ylitie,
/// Karras, Laine 2017). `boxes` has one for each node of the binary shape.
[[nodiscard]] TreeShape widened(const TreeShape& binary, std::span<const Aabb> boxes, unsigned degree);

/// Returns the box around the triangles of each node.
[[nodiscard]] std::vector<Aabb> boxes_of(const TreeShape& shape, std::span<const TriangleVertices> triangles,
                                         std::span<const Vec3> positions);

}  // namespace espalier::bench
