// Every triangle of a blob, in storage order, and every node.
#include <espalier/walk.hpp>
#include <runtime/blob/duplicate_references.hpp>
#include <runtime/lattice/to_local.hpp>
#include <runtime/traversal/find_triangle.hpp>
#include <runtime/traversal/find.hpp>

namespace espalier {
namespace detail {
namespace {

struct FoundCorners : Found {
    Triangle corners;
};

struct EachWithCorners : Answer {
    TriangleVisitor visit;

    explicit EachWithCorners(TriangleVisitor with_each) : visit(with_each) {}
    [[nodiscard]] Visit take(const FoundCorners& found) const { return visit(TriangleId{found.index}, found.corners); }
};

struct AllTriangles {
    const BlobData& blob;

    template <class Node>
    static unsigned cull(const Node& node, float, float*) {
        return all_children(node);
    }
    template <class Leaf>
    [[nodiscard]] Visit decide(const Leaf& leaf, unsigned slot, const LatticeTriangle& triangle,
                               EachWithCorners& answer) const {
        const std::uint32_t index = scalar::storage_index(leaf, slot);
        if (is_duplicate_reference(blob, index)) return Visit::next;
        return answer.take({{index, index}, answer.visit.takes_corners() ? corners_of(blob, triangle) : Triangle()});
    }
};

/// Calls a visitor with each node. The walk does not track depth: it is counted here, from how many nodes wait on each
/// level.
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
                scalar::with_leaf<LeafKind>(blob, node, i - nodes, [&](const LeafKind& leaf) {
                    child.first = TriangleId{scalar::storage_index(leaf, 0)};
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
        stopped = answer == NodeVisit::stop;
        const unsigned nodes = answer == NodeVisit::descend ? node.node_children() : 0;
        // mutant(!= -> true) work: enters an empty level and leaves it
        if (nodes != 0) waiting[++depth] = static_cast<std::uint8_t>(nodes);
        // mutant(> -> >=) equivalent: the first level is empty only at the end
        while (depth > 1 && waiting[depth] == 0) --depth;
        return (1u << nodes) - 1u;
    }
    static Visit visit_leaf(const LeafKind&) { return Visit::next; }
};

}  // namespace
}  // namespace detail

QueryStatus for_each_triangle(const Blob& blob, TriangleVisitor visit) noexcept {
    const detail::BlobData& data = detail::data_of(blob);
    if (data.bytes == nullptr) return QueryStatus::not_open;
    if (data.triangle_count == 0) return QueryStatus::ok;
    detail::AllTriangles shape = {data};
    detail::EachWithCorners answer(visit);
    return detail::scalar::find_in_order(data, shape, answer) ? QueryStatus::stopped : QueryStatus::ok;
}

Result<Triangle> triangle_at(const Blob& blob, TriangleId triangle) noexcept {
    Result<Triangle> corners;
    if (detail::data_of(blob).bytes == nullptr) return corners;
    corners.status = triangle.index < blob.triangle_count() ? QueryStatus::ok : QueryStatus::invalid_argument;
    if (corners) corners.value = detail::corners_at(detail::data_of(blob), triangle.index, nullptr);
    return corners;
}

QueryStatus for_each_node(const Blob& blob, FunctionRef<NodeVisit(const TreeNode&)> visit) noexcept {
    const detail::BlobData& data = detail::data_of(blob);
    if (data.bytes == nullptr) return QueryStatus::not_open;
    if (data.triangle_count == 0) return QueryStatus::ok;
    return detail::scalar::with_leaves_of(data, [&]<class Leaf>() {
        detail::EveryNode<Leaf> visitor = {data, visit};
        detail::scalar::visit_in_storage_order<Leaf>(data, visitor);
        return visitor.stopped ? QueryStatus::stopped : QueryStatus::ok;
    });
}

}  // namespace espalier
