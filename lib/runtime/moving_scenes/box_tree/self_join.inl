// The tree over moving instances against itself: two nodes of one level at a time, a box of the one against all boxes
// of the other.
#ifndef ESPALIER_IN_INSTRUCTION_SET  // parsed alone
#include <bit>

#include <runtime/moving_scenes/box_tree/self_join.hpp>
#include <runtime/traversal/alone.hpp>
#endif

namespace {

/// Returns which children of a node touch a box, a bit for each.
[[gnu::always_inline]] inline unsigned touching(const BoxNode& node, const StepsBox& box) {
    unsigned mask = 0;
    for (unsigned first = 0; first < BoxNode::most; first += lanes) {
        auto apart = load_as<SignedInts>(&node.low[0][first]) > box.high[0];
        apart = apart | (load_as<SignedInts>(&node.high[0][first]) < box.low[0]);
        for (int k = 1; k < 3; ++k) {
            apart = apart | (load_as<SignedInts>(&node.low[k][first]) > box.high[k]);
            apart = apart | (load_as<SignedInts>(&node.high[k][first]) < box.low[k]);
        }
        mask |= (bits_of(apart) ^ ((1u << lanes) - 1u)) << first;
    }
    return mask;
}

/// Two nodes, and which of their children are still to be visited.
struct JoinStep {
    std::uint32_t a, b;
    unsigned child;             ///< of a
    unsigned waiting;           ///< children of b that touch it
    unsigned marks_a, marks_b;  ///< children with a mark in them: one of a pair must have it

    JoinStep() = default;
    JoinStep(const SceneBlock& block, bool only_marked, std::uint32_t first, std::uint32_t second)
        : a(first),
          b(second),
          child(~0u),
          waiting(0),
          marks_a(only_marked ? block.dirty[first] : ~0u),
          marks_b(only_marked ? block.dirty[second] : ~0u) {}
    /// Returns the children of b that count for the child at hand.
    [[nodiscard]] unsigned selected() const { return (marks_a >> child & 1u) != 0 ? ~0u : marks_b; }
};

}  // namespace

void join_with_itself(const SceneBlock& block, bool only_marked, const OnTouchingBoxes& visit) {
    const BlockHead& head = *block.head;
    if (head.levels == 0) return;
    JoinStep path[most_tree_levels];
    std::uint32_t depth = 0;
    path[0] = JoinStep(block, only_marked, head.root, head.root);
    for (;;) {
        JoinStep& step = path[depth];
        const BoxNode &a = block.node(step.a), &b = block.node(step.b);
        const bool is_leaf = depth + 1 == head.levels;
        while (step.waiting == 0 && ++step.child < BoxNode::most) {
            if (step.selected() == 0) continue;
            step.waiting = touching(b, a.box(step.child)) & step.selected();
            // A node against itself: each pair once, and of inner nodes each child against itself.
            if (step.a == step.b) step.waiting &= ~0u << (step.child + (is_leaf ? 1u : 0u));
        }
        if (step.waiting == 0) {
            if (depth == 0) return;
            --depth;
            continue;
        }
        const std::uint32_t first = a.child[step.child];
        if (is_leaf) {
            for (; step.waiting != 0; step.waiting &= step.waiting - 1)
                visit(first, b.child[static_cast<unsigned>(std::countr_zero(step.waiting))]);
            continue;
        }
        const std::uint32_t second = b.child[static_cast<unsigned>(std::countr_zero(step.waiting))];
        step.waiting &= step.waiting - 1;
        path[++depth] = JoinStep(block, only_marked, first, second);
    }
}
