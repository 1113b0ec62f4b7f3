// Removal from the tree: a node that is left with too few children joins a sibling, or takes a child of it.
#include <runtime/moving_scenes/box_tree/tree.hpp>

namespace espalier::detail {

namespace {

/// Returns the place of the child with the least cost(place, its box); of equal ones the first.
template <class Cost>
unsigned least_child(const BoxNode& node, Cost cost) {
    unsigned best = BoxNode::most;
    float least = infinity;
    for (unsigned i = 0; i < BoxNode::most; ++i) {
        if (node.child[i] == no_child) continue;
        const float of_child = cost(i, node.box(i));
        if (of_child >= least) continue;
        best = i;
        least = of_child;
    }
    return best;
}

/// Returns the place of the sibling that grows least if it takes a node's box.
unsigned nearest_sibling(const BoxNode& parent, unsigned place) {
    return least_child(parent, [&](unsigned i, StepsBox box) {
        const float own = box.half_area();
        box.add(parent.box(place));
        return i == place ? infinity : box.half_area() - own;
    });
}

/// Moves a child of one node into another, which has a free place.
void move_child(SceneBlock& block, std::uint32_t level, std::uint32_t from, unsigned place, std::uint32_t to) {
    const StepsBox box = block.node(from).box(place);
    const std::uint32_t child = block.node(from).child[place];
    block.node(from).drop(place);
    put_child(block, level, to, block.node(to).free_place(), box, child);
}

/// Moves the child of a sibling by which a node grows least.
void take_nearest(SceneBlock& block, std::uint32_t level, std::uint32_t sibling, std::uint32_t node) {
    const StepsBox own = block.node(node).bounds();
    const unsigned best = least_child(block.node(sibling), [&](unsigned, StepsBox box) {
        box.add(own);
        return box.half_area();
    });
    move_child(block, level, sibling, best, node);
}

}  // namespace

void remove_box(SceneBlock& block, std::uint32_t slot) {
    BlockHead& head = *block.head;
    std::uint32_t node = block.slots[slot].place / 8;
    block.node(node).drop(block.slots[slot].place % 8);
    for (std::uint32_t level = 0;; ++level) {
        const std::uint32_t above = block.parent[node];
        const unsigned count = block.node(node).count();
        if (above == no_child || count >= BoxNode::least) break;
        BoxNode& parent = block.node(above / 8);
        parent.set_box(above % 8, block.node(node).bounds());
        const unsigned place = nearest_sibling(parent, above % 8);
        const std::uint32_t sibling = parent.child[place];
        if (block.node(sibling).count() + count > BoxNode::most) {
            take_nearest(block, level, sibling, node);
            parent.set_box(place, block.node(sibling).bounds());
            parent.set_box(above % 8, block.node(node).bounds());
            node = above / 8;
            break;
        }
        for (unsigned i = 0; i < BoxNode::most; ++i)
            if (block.node(node).child[i] != no_child) move_child(block, level, node, i, sibling);
        parent.set_box(place, block.node(sibling).bounds());
        parent.drop(above % 8);
        give_back_node(block, node);
        node = above / 8;
    }
    renew_ancestors(block, node);
    // A root of one node is left out; the last instance takes its leaf node along.
    while (head.levels > 1 && block.node(head.root).count() == 1) {
        const BoxNode& root = block.node(head.root);
        unsigned only = 0;
        while (root.child[only] == no_child) ++only;
        const std::uint32_t child = root.child[only];
        give_back_node(block, head.root);
        block.parent[child] = no_child;
        head.root = child;
        --head.levels;
    }
    if (head.levels == 1 && block.node(head.root).count() == 0) {
        give_back_node(block, head.root);
        head.root = no_child;
        head.levels = 0;
    }
}

}  // namespace espalier::detail
