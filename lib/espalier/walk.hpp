// Walking over what a blob holds.
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>
#include <espalier/format.hpp>
#include <espalier/function_ref.hpp>
#include <espalier/shapes.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// Every triangle but copies in storage order, its corners rounded to float, until the visitor answers stop. True when
/// it saw all.
bool for_each_triangle(const Blob& blob, FunctionRef<Visit(Triangle, const Corners&)> visit);

/// The corners of one triangle, rounded to float as for_each_triangle gives them. False, and `corners` untouched, when
/// there is no such triangle. Looks at the children of a node for each level of the tree.
bool triangle_corners(const Blob& blob, Triangle triangle, Corners& corners) noexcept;

/// A child of a node: another node, or a leaf, which is a run of triangles.
struct TreeChild {
    Box box;  ///< rounded outward: it holds every corner below the child, as rounded to float too
    bool is_leaf = false;
    std::uint32_t node = 0;   ///< of a node: its number
    Triangle first;           ///< of a leaf: its first triangle
    std::uint32_t count = 0;  ///< of a leaf: how many triangles, copies counted in
};

struct TreeNode {
    std::uint32_t number = 0;  ///< 0 is the root
    unsigned depth = 0;        ///< 1 is the root's, Blob::depth() the largest
    unsigned child_count = 0;
    TreeChild children[format::max_children];  ///< nodes first, then leaves
};

/// What a visitor of nodes answers.
enum class NodeVisit : std::uint8_t {
    descend,  ///< go on to the node children
    skip,     ///< go on, but not below this node
    end,
};

/// The nodes of the tree, parents before their children, for views of the tree when debugging. True unless the visitor
/// said end. An empty blob has none. A box holds what is below it in every blob that was baked; of bytes that a
/// stranger made, `open` does not prove it.
bool for_each_node(const Blob& blob, FunctionRef<NodeVisit(const TreeNode&)> visit);

}  // namespace espalier
