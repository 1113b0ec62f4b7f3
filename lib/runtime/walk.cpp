// Every triangle of a blob, in storage order, and every node.
#include <bit>

#include <espalier/walk.hpp>
#include <runtime/copies.hpp>
#include <runtime/find_triangle.hpp>
#include <runtime/lattice_world.hpp>
#include <runtime/outward.hpp>
#include <runtime/scalar_walk.hpp>

namespace espalier {
namespace detail {
namespace {

Corners corners_of(const BlobData& blob, const LatticeTriangle& triangle) {
    return {to_world(blob, triangle.corner[0]), to_world(blob, triangle.corner[1]), to_world(blob, triangle.corner[2])};
}

struct EveryTriangle {
    const BlobData& blob;
    FunctionRef<Visit(Triangle, const Corners&)> visit;

    template <class Node>
    static unsigned children(const Node& node, float*) {
        return all_children(node);
    }
    template <class Leaf>
    [[nodiscard]] Visit visit_leaf(const Leaf& leaf) const {
        return scalar_walk::for_each_triangle_of(leaf, [&](unsigned slot, const LatticeTriangle& triangle) {
            const std::uint32_t index = scalar::storage_index(leaf, slot);
            return is_copy(blob, index) ? keep_going : visit(Triangle{index}, corners_of(blob, triangle));
        });
    }
};

/// The walk tells no node's depth: it is counted here, from how many nodes wait on each level.
template <class LeafKind>
struct EveryNode {
    const BlobData& blob;
    FunctionRef<NodeVisit(const TreeNode&)> visit;
    bool stopped = false;
    unsigned depth = 1;
    std::uint8_t waiting[format::max_depth + 1] = {0, 1};

    template <class Node>
    [[nodiscard]] TreeNode describe(const Node& node) const {
        TreeNode seen;
        // mutant(- -> +) equivalent: pointers cannot be added, so the mutant is the original
        seen.number = static_cast<std::uint32_t>((node.bytes - blob.nodes) / static_cast<int>(Node::size));
        seen.depth = depth;
        const unsigned nodes = node.node_children();
        seen.child_count = nodes + node.leaf_children();
        for (unsigned i = 0; i < seen.child_count; ++i) {
            TreeChild& child = seen.children[i];
            const auto below = [&](int axis) { return world_below(blob, axis, node.low(axis, i, blob.bits)); };
            const auto above = [&](int axis) { return world_above(blob, axis, node.high(axis, i, blob.bits)); };
            child.box = {{below(0), below(1), below(2)}, {above(0), above(1), above(2)}};
            child.is_leaf = i >= nodes;
            if (child.is_leaf) {
                scalar_walk::with_leaf<LeafKind>(blob, node, i - nodes, [&](const LeafKind& leaf) {
                    child.first = Triangle{scalar::storage_index(leaf, 0)};
                    child.count = leaf.triangle_count();
                });
            } else {
                child.node = node.first_child() + i;
            }
        }
        return seen;
    }
    template <class Node>
    unsigned children(const Node& node, float*) {
        if (stopped) return 0;
        --waiting[depth];
        const NodeVisit answer = visit(describe(node));
        stopped = answer == NodeVisit::end;
        const unsigned nodes = answer == NodeVisit::descend ? node.node_children() : 0;
        // mutant(!= -> true) work: enters an empty level and leaves it
        if (nodes != 0) waiting[++depth] = static_cast<std::uint8_t>(nodes);
        // mutant(> -> >=) equivalent: the first level is empty only at the end
        while (depth > 1 && waiting[depth] == 0) --depth;
        return (1u << nodes) - 1u;
    }
    static Visit visit_leaf(const LeafKind&) { return keep_going; }
};

}  // namespace
}  // namespace detail

bool for_each_triangle(const Blob& blob, FunctionRef<Visit(Triangle, const Corners&)> visit) {
    if (blob.triangle_count() == 0) return true;
    detail::EveryTriangle visitor = {blob.data(), visit};
    return detail::scalar_walk::with_leaves_of(blob.data(), [&]<class Leaf>() {
        return detail::scalar_walk::traverse_in_storage_order<Leaf>(blob.data(), visitor) == keep_going;
    });
}

bool triangle_corners(const Blob& blob, Triangle triangle, Corners& corners) noexcept {
    if (triangle.index >= blob.triangle_count()) return false;
    corners = detail::corners_of(blob.data(), detail::find_triangle(blob.data(), triangle.index));
    return true;
}

bool for_each_node(const Blob& blob, FunctionRef<NodeVisit(const TreeNode&)> visit) {
    if (blob.triangle_count() == 0) return true;
    return detail::scalar_walk::with_leaves_of(blob.data(), [&]<class Leaf>() {
        detail::EveryNode<Leaf> visitor = {blob.data(), visit};
        detail::scalar_walk::traverse_in_storage_order<Leaf>(blob.data(), visitor);
        return !visitor.stopped;
    });
}

}  // namespace espalier
