// The two ways through a tree for small cores, which have little stack: what waits is a word a level. Visitors as for
// traverse.hpp;  only children of `among` are tested.
#ifndef ESPALIER_RAYS_SMALL_CODE_WALK_HPP
#define ESPALIER_RAYS_SMALL_CODE_WALK_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/rays/small_code/seen_ray.hpp>

ESPALIER_BEGIN_SET

struct Keys {
    unsigned among;
};

/// Nodes on the way down of which some children have not had their turn: eight bits of these above each index, the
/// others in a byte.
template <class Node>
class WaitingNodes {
    static_assert(format::max_nodes <= 1u << 24 && Node::max_children <= 16);
    static constexpr bool is_wide = Node::max_children > 8;

public:
    ESPALIER_ALWAYS_INLINE void push(std::uint32_t node, unsigned children) {
        // mutant(<< -> one less) huge: the bit for nodes beyond the first eight million
        nodes_[size_] = children << 24 | node;
        if constexpr (is_wide) others_[size_] = static_cast<std::uint8_t>(children >> 8);
        ++size_;
    }
    /// False when there are none.
    ESPALIER_ALWAYS_INLINE bool pop(std::uint32_t& node, unsigned& children) {
        if (size_ == 0) return false;
        --size_;
        node = nodes_[size_] & ((1u << 24) - 1u);
        children = nodes_[size_] >> 24;
        if constexpr (is_wide) children |= unsigned{others_[size_]} << 8;
        return true;
    }

private:
    static constexpr unsigned most = format::max_depth - 1;  ///< the deepest nodes have leaves alone

    std::uint32_t nodes_[most];
    std::uint8_t others_[is_wide ? most : 1];
    std::uint8_t size_ = 0;  ///< a byte: the stack has no room for three more
};

/// A walk to the children with the smallest keys first. Once it has gone down to one of them, or a leaf has been
/// visited, the others are tested again: that is more exact by then, and no keys need to wait.
template <class Leaf, class Visitor>
ESPALIER_ALWAYS_INLINE inline void traverse_nearest_first(const BlobData& blob, Visitor& visitor) {
    using Node = typename Leaf::Node;
    WaitingNodes<Node> waiting;
    std::uint32_t index = 0;
    unsigned among = every_child_of<Node>;
    do {
        count_node_step();
        const Node node = node_at<Node>(blob, index);
        const unsigned seen = visitor.children(node, {among});
        among = SeenChildren<Node>::children(seen);
        if (among == 0) continue;
        const unsigned nearest = SeenChildren<Node>::nearest(seen);
        among &= ~(1u << nearest);
        const unsigned node_children = node.node_children();
        if (nearest < node_children) {
            if (among != 0) waiting.push(index, among);
            index = node.first_child() + nearest;
            among = every_child_of<Node>;
        } else {
            count_leaf_step();
            if (visit_leaf<Leaf>(blob, node, nearest - node_children, visitor) == Visit::stop) return;
        }
    } while (among != 0 || waiting.pop(index, among));
}

/// Visits children in storage order. Returns stop if the visitor does.
template <class Leaf, class Visitor>
ESPALIER_ALWAYS_INLINE inline Visit walk_in_storage_order(const BlobData& blob, Visitor& visitor) {
    using Node = typename Leaf::Node;
    WaitingNodes<Node> waiting;
    std::uint32_t index = 0;
    for (;;) {
        count_node_step();
        const Node node = node_at<Node>(blob, index);
        const unsigned mask = SeenChildren<Node>::children(visitor.children(node, {every_child_of<Node>}));
        const unsigned node_children = node.node_children();
        for (unsigned number = 0; mask >> node_children >> number != 0; ++number) {
            if ((mask >> node_children >> number & 1u) == 0) continue;
            count_leaf_step();
            if (visit_leaf<Leaf>(blob, node, number, visitor) == Visit::stop) return Visit::stop;
        }
        std::uint32_t first = node.first_child();
        unsigned nodes = mask & ((1u << node_children) - 1u);
        if (nodes == 0 && !waiting.pop(first, nodes)) return Visit::next;
        index = first + static_cast<unsigned>(std::countr_zero(nodes));
        nodes &= nodes - 1;
        if (nodes != 0) waiting.push(first, nodes);
    }
}

ESPALIER_END_SET

#endif
