#include <bit>

#include <runtime/find_triangle.hpp>
#include <runtime/scalar_walk.hpp>

namespace espalier::detail {
namespace {

/// Storage indices ascend in the order of the walk (open proves it), a node's own leaves before what is below its node
/// children: so each subtree is a run of indices, and one child of each node holds the one that is looked for.
template <class Leaf>
std::uint32_t first_below(const BlobData& blob, std::uint32_t number) {
    using Node = typename Leaf::Node;
    Node node = node_at<Node>(blob, number);
    while (node.leaf_children() == 0) node = node_at<Node>(blob, node.first_child());
    return load_u32(node.leaf_block(blob));  // blocks of both kinds begin with it
}

template <class Leaf>
LatticeTriangle triangle_in(const Leaf& leaf, std::uint32_t skip) {
    auto slots = leaf.used_slots();
    for (; skip != 0; --skip) slots &= slots - 1;
    return leaf.triangle(static_cast<unsigned>(std::countr_zero(slots)));
}

}  // namespace

LatticeTriangle find_triangle(const BlobData& blob, std::uint32_t index) {
    return scalar_walk::with_leaves_of(blob, [&]<class Leaf>() {
        using Node = typename Leaf::Node;
        Node node = node_at<Node>(blob, 0);
        for (;;) {
            count_node_step();
            unsigned child = node.node_children();
            while (child != 0 && first_below<Leaf>(blob, node.first_child() + child - 1) > index) --child;
            if (child == 0) break;
            node = node_at<Node>(blob, node.first_child() + child - 1);
        }
        for (unsigned number = 0;; ++number) {
            count_leaf_step();
            LatticeTriangle triangle;
            const bool is_found = scalar_walk::with_leaf<Leaf>(blob, node, number, [&](const Leaf& leaf) {
                const std::uint32_t skip = index - scalar::storage_index(leaf, 0);
                if (skip >= leaf.triangle_count()) return false;
                triangle = triangle_in(leaf, skip);
                return true;
            });
            if (is_found) return triangle;
        }
    });
}

}  // namespace espalier::detail
