// Walks over the contents of a blob: its triangles and the nodes of its tree.
//
// Any number of threads may walk the same blob, and no call allocates.
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>
#include <espalier/format.hpp>
#include <espalier/base/function_ref.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// Visits every triangle once, in ascending order, until the visitor stops. Duplicate references are omitted, and
/// corners are rounded to float. Returns ok, stopped or not_open. O(n).
QueryStatus for_each_triangle(const Blob& blob, TriangleVisitor visit) noexcept;

/// Returns the corners of one triangle, rounded to float like those of for_each_triangle(). Refuses an index from
/// Blob::triangle_count() on (invalid_argument). Cost: O(depth); on each level, the children of one node are read.
[[nodiscard]] Result<Triangle> triangle_at(const Blob& blob, TriangleId triangle) noexcept;

/// A child of a node: another node, or a leaf, which is a range of triangles.
struct TreeChild {
    Box box;  ///< rounded outward: contains every corner below the child, even as rounded to float
    bool is_leaf = false;
    std::uint32_t node = 0;   ///< if it is a node: its number
    TriangleId first;         ///< if it is a leaf: its first triangle
    std::uint32_t count = 0;  ///< if it is a leaf: its number of triangles, including duplicate references
};

/// A node of the tree.
struct TreeNode {
    std::uint32_t number = 0;  ///< 0 is the root
    unsigned depth = 0;        ///< 1 for the root, at most Blob::depth()
    unsigned child_count = 0;
    TreeChild children[format::max_children];  ///< nodes first, then leaves
};

/// Returned by a visitor of nodes.
enum class NodeVisit : std::uint8_t {
    descend,  ///< continue with the node's children
    skip,     ///< continue, but not below this node
    stop,     ///< end the walk
};

/// Visits the nodes of the tree, parents before their children, for debugging and drawing. A blob without triangles has
/// no nodes. In every blob that was baked, a box contains everything below it; open() does not prove this for bytes
/// from elsewhere. Returns ok, stopped or not_open. O(nodes visited).
QueryStatus for_each_node(const Blob& blob, FunctionRef<NodeVisit(const TreeNode&)> visit) noexcept;

}  // namespace espalier
