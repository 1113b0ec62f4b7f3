#include <bit>

#include <espalier/base/function_ref.hpp>
#include <runtime/lattice/to_local.hpp>
#include <runtime/traversal/find_triangle.hpp>
#include <runtime/traversal/find.hpp>

namespace espalier::detail {
namespace {

/// One more than the node child that holds the index; 0 if an own leaf of the node does.
template <class Leaf>
unsigned node_child_above(const BlobData& blob, const typename Leaf::Node& node, std::uint32_t index) {
    unsigned child = node.node_children();
    while (child != 0 && first_below<Leaf>(blob, node.first_child() + child - 1) > index) --child;
    return child;
}

template <class Leaf>
LatticeTriangle triangle_in(const Leaf& leaf, std::uint32_t skip) {
    auto slots = leaf.used_slots();
    for (; skip != 0; --skip) slots &= slots - 1;
    return leaf.triangle(static_cast<unsigned>(std::countr_zero(slots)));
}

}  // namespace

IntegerBounds bounds_of(const LatticeTriangle& triangle) {
    IntegerBounds bounds;
    for (int k = 0; k < 3; ++k) {
        const Span span = span_of(triangle, k);
        bounds.low[k] = span.low;
        bounds.high[k] = span.high;
    }
    return bounds;
}

LatticeTriangle find_triangle(const BlobData& blob, std::uint32_t index) {
    return scalar::with_leaves_of(blob, [&]<class Leaf>() {
        using Node = typename Leaf::Node;
        Node node = node_at<Node>(blob, 0);
        for (;;) {
            count_node_step();
            const unsigned child = node_child_above<Leaf>(blob, node, index);
            if (child == 0) break;
            node = node_at<Node>(blob, node.first_child() + child - 1);
        }
        for (unsigned number = 0;; ++number) {
            count_leaf_step();
            LatticeTriangle triangle;
            const bool is_found = scalar::with_leaf<Leaf>(blob, node, number, [&](const Leaf& leaf) {
                const std::uint32_t skip = index - scalar::storage_index(leaf, 0);
                if (skip >= leaf.triangle_count()) return false;
                triangle = triangle_in(leaf, skip);
                return true;
            });
            if (is_found) return triangle;
        }
    });
}

unsigned child_holding(const BlobData& blob, std::uint32_t node_index, std::uint32_t index) {
    return scalar::with_leaves_of(blob, [&]<class Leaf>() {
        count_node_step();
        const auto node = node_at<typename Leaf::Node>(blob, node_index);
        if (const unsigned above = node_child_above<Leaf>(blob, node, index); above != 0) return above - 1;
        const auto holds = [&](const Leaf& leaf) {
            count_leaf_step();
            return index - scalar::storage_index(leaf, 0) < leaf.triangle_count();
        };
        unsigned number = 0;
        while (!scalar::with_leaf<Leaf>(blob, node, number, holds)) ++number;
        return node.node_children() + number;
    });
}

Triangle corners_at(const BlobData& blob, std::uint32_t index, const LatticeTriangle* triangle) noexcept {
    return triangle != nullptr ? corners_of(blob, *triangle) : corners_of(blob, find_triangle(blob, index));
}

}  // namespace espalier::detail
