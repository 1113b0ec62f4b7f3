// The binary tree between building and collapsing.
#pragma once

#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <espalier/format.hpp>

#include <baker/base/lane_box.hpp>

namespace espalier::baker {

/// Three binary levels fit into one wide node, so a binary tree of this height fits into the format's depth.
inline constexpr unsigned max_binary_height = 3 * format::max_depth;

/// The box around `count` triangles, the ones from `first` on in BinaryTree::triangles. A node of one triangle is a
/// leaf. The nodes of a subtree lie together: the left child follows its parent, the right child follows the left
/// subtree. Hence a node's place depends on the tree alone, and threads can fill in subtrees in any order.
struct BinaryNode {
    float lo[3];
    std::uint32_t first;
    float hi[3];
    std::uint32_t count;

    [[nodiscard]] bool is_leaf() const { return count == 1; }
    [[nodiscard]] LaneBox box() const { return lane_box_of(*this); }
    [[nodiscard]] double half_area() const {
        const double x = double(hi[0]) - double(lo[0]);
        const double y = double(hi[1]) - double(lo[1]);
        const double z = double(hi[2]) - double(lo[2]);
        return x * y + y * z + z * x;
    }
};
static_assert(sizeof(BinaryNode) == 32);

/// Nodes in a subtree of `count` triangles.
[[nodiscard]] constexpr std::size_t subtree_nodes(std::uint32_t count) { return 2 * std::size_t{count} - 1; }

/// Levels below the root of the lowest tree of `count` triangles, one or more.
[[nodiscard]] constexpr unsigned balanced_height(std::uint32_t count) {
    return static_cast<unsigned>(std::bit_width(count - 1));
}

struct BinaryTree {
    std::unique_ptr<BinaryNode[]> nodes;   ///< subtree_nodes(triangles.size()) of them; none for an empty mesh
    std::vector<std::uint32_t> triangles;  ///< numbers into LatticeMesh::triangles

    [[nodiscard]] std::size_t node_count() const { return triangles.empty() ? 0 : 2 * triangles.size() - 1; }
    [[nodiscard]] static std::size_t left_of(std::size_t node) { return node + 1; }
    [[nodiscard]] std::size_t right_of(std::size_t node) const {
        return node + 1 + subtree_nodes(nodes[node + 1].count);
    }
};

}  // namespace espalier::baker
