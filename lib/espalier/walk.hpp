// Walks over the contents of a blob: its triangles and the nodes of its tree.
//
// Thread safety: any number of threads may walk one blob. No call allocates.
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>
#include <espalier/format.hpp>
#include <espalier/base/function_ref.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// Visits every triangle once, in ascending order, until the visitor stops. Duplicate references are left out. Corners
/// are rounded to float. Returns ok, stopped or not_open. Cost: O(n).
QueryStatus for_each_triangle(const Blob& blob, TriangleVisitor visit) noexcept;

/// Returns the corners of one triangle, rounded to float as for_each_triangle() does. An index from
/// Blob::triangle_count() on is refused with invalid_argument. Cost: O(depth); reads the children of one node a level.
[[nodiscard]] Result<Triangle> triangle_at(const Blob& blob, TriangleId triangle) noexcept;

/// A child of a node: another node, or a leaf, which is a run of triangles.
struct TreeChild {
    Box box;  ///< rounded outward: it holds every corner below the child, also as rounded to float
    bool is_leaf = false;
    std::uint32_t node = 0;   ///< of a node: its number
    TriangleId first;         ///< of a leaf: its first triangle
    std::uint32_t count = 0;  ///< of a leaf: how many triangles, duplicate references included
};

/// A node of the tree.
struct TreeNode {
    std::uint32_t number = 0;  ///< 0 is the root
    unsigned depth = 0;        ///< 1 is the root's, Blob::depth() the largest
    unsigned child_count = 0;
    TreeChild children[format::max_children];  ///< nodes first, then leaves
};

/// The result of a visitor of nodes.
enum class NodeVisit : std::uint8_t {
    descend,  ///< go on to the node children
    skip,     ///< go on, but not below this node
    stop,     ///< end the walk
};

/// Visits the nodes of the tree, parents before their children, for debugging and drawing. A blob without triangles has
/// no nodes. In every blob that was baked, a box holds what is below it; open() does not prove that for bytes of other
/// origin. Returns ok, stopped or not_open. Cost: O(nodes visited).
QueryStatus for_each_node(const Blob& blob, FunctionRef<NodeVisit(const TreeNode&)> visit) noexcept;

}  // namespace espalier
