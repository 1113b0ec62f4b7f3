// From a storage index to the triangle.
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/blob/node.hpp>
#include <runtime/lattice/triangle.hpp>
#include <runtime/traversal/box_nodes.hpp>

namespace espalier::detail {

/// Returns the lowest storage index below a node. Storage indices ascend in the order of the walk (open proves it), a
/// node's own leaves before what is below its node children: each subtree is a run of indices, and one child of each
/// node holds an index.
template <class Leaf>
std::uint32_t first_below(const BlobData& blob, std::uint32_t number) {
    using Node = typename Leaf::Node;
    Node node = node_at<Node>(blob, number);
    while (node.leaf_children() == 0) node = node_at<Node>(blob, node.first_child());
    return load_u32(node.leaf_block(blob));  // blocks of both kinds begin with it
}

/// Requires index < blob.triangle_count. Reads a few nodes a level and one leaf.
LatticeTriangle find_triangle(const BlobData& blob, std::uint32_t index);

/// Returns the bounds of the corners.
IntegerBounds bounds_of(const LatticeTriangle& triangle);

/// Returns the child of a node below which the triangle of that storage index lies; it must lie below the node.
unsigned child_holding(const BlobData& blob, std::uint32_t node, std::uint32_t index);

}  // namespace espalier::detail
