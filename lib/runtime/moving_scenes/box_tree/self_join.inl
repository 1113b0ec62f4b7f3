// The tree over moving instances against itself: two nodes of one level at a time, and of each only the children that
// touch the other's box. Children of leaf nodes are compared in chunks.
#ifndef ESPALIER_IN_INSTRUCTION_SET  // parsed alone
#include <bit>

#include <runtime/moving_scenes/box_tree/self_join.hpp>
#include <runtime/traversal/alone.hpp>
#endif

namespace {

/// Returns which of some children of a node touch a box, a bit for each.
[[gnu::always_inline]] inline unsigned touching(const BoxNode& node, const StepsBox& box, unsigned among) {
    unsigned mask = 0;
    if constexpr (lanes == 1) {  // only those, and only as far as it is needed
        for (; among != 0; among &= among - 1) {
            const auto i = static_cast<unsigned>(std::countr_zero(among));
            bool apart = false;
            for (int k = 0; k < 3 && !apart; ++k) apart = node.low[k][i] > box.high[k] || node.high[k][i] < box.low[k];
            mask |= (apart ? 0u : 1u) << i;
        }
        return mask;
    }
    for (unsigned first = 0; first < BoxNode::most; first += lanes) {
        auto apart = load_as<SignedInts>(&node.low[0][first]) > box.high[0];
        apart = apart | (load_as<SignedInts>(&node.high[0][first]) < box.low[0]);
        for (int k = 1; k < 3; ++k) {
            apart = apart | (load_as<SignedInts>(&node.low[k][first]) > box.high[k]);
            apart = apart | (load_as<SignedInts>(&node.high[k][first]) < box.low[k]);
        }
        mask |= (bits_of(apart) ^ ((1u << lanes) - 1u)) << first;
    }
    return mask & among;
}
/// Returns which children of a node touch a box. A place without a child has an empty box.
[[gnu::always_inline]] inline unsigned touching(const BoxNode& node, const StepsBox& box) {
    return touching(node, box, (1u << BoxNode::most) - 1);
}

/// A child of a leaf node, against some children of another or the same one.
struct ChildAgainstNode {
    std::uint32_t place;  ///< 8 * node + child
    std::uint32_t node;
    std::uint32_t children;
};

/// The pairs of leaf nodes that a walk finds, which are compared in chunks: in each chunk nothing waits for a branch
/// that no processor could foresee.
class LeafNodePairs {
public:
    LeafNodePairs(const SceneBlock& block, const OnTouchingBoxes& visit) : block_(block), visit_(visit) {}

    /// Adds a pair of leaf nodes, which touch. Of each only the children count that touch the other's box.
    [[gnu::always_inline]] void add(std::uint32_t a, const StepsBox& box_a, std::uint32_t b, const StepsBox& box_b) {
        const unsigned children_a = touching(block_.node(a), box_b), children_b = touching(block_.node(b), box_a);
        for (unsigned child = 0; child < BoxNode::most; ++child) {
            // A node against itself: each pair once.
            const unsigned behind = a == b ? ~1u << child : ~0u;
            waiting_[count_] = {8 * a + child, b, children_b & behind};
            count_ += children_a >> child & 1u;
        }
        if (count_ >= chunk) flush();
    }
    /// Visits the pairs of children of what was added.
    [[gnu::noinline]] void flush() {
        unsigned found = 0;
        for (unsigned i = 0; i < count_; ++i) {
            ChildAgainstNode entry = waiting_[i];
            const StepsBox box = block_.node(entry.place / 8).box(entry.place % 8);
            entry.children = touching(block_.node(entry.node), box, entry.children);
            waiting_[found] = entry;
            found += entry.children != 0 ? 1u : 0u;
        }
        for (unsigned i = 0; i < found; ++i) {
            const ChildAgainstNode& entry = waiting_[i];
            const std::uint32_t first = block_.node(entry.place / 8).child[entry.place % 8];
            for (unsigned rest = entry.children; rest != 0; rest &= rest - 1)
                visit_(first, block_.node(entry.node).child[std::countr_zero(rest)]);
        }
        count_ = 0;
    }

private:
    static constexpr unsigned chunk = small_code ? 8 : 64;

    const SceneBlock& block_;
    const OnTouchingBoxes& visit_;
    unsigned count_ = 0;
    ChildAgainstNode waiting_[chunk + BoxNode::most];
};

/// Two nodes above the leaf nodes, and which of their children are still to be visited.
struct JoinStep {
    std::uint32_t a, b;
    unsigned children_a;  ///< those of a that touch b, without the one at hand
    unsigned children_b;  ///< those of b that touch a
    unsigned child;       ///< of a, at hand
    unsigned waiting;     ///< children of b that touch it

    /// Returns a step for two nodes with their boxes, which touch.
    [[gnu::always_inline]] JoinStep(const SceneBlock& block, std::uint32_t first, const StepsBox& box_of_first,
                                    std::uint32_t second, const StepsBox& box_of_second)
        : a(first),
          b(second),
          children_a(touching(block.node(first), box_of_second)),
          children_b(touching(block.node(second), box_of_first)),
          child(0),
          waiting(0) {}
    JoinStep() = default;

    /// Returns whether there is a next pair of children, and takes it from those that wait.
    [[gnu::always_inline]] bool take(const SceneBlock& block, unsigned& place) {
        while (waiting == 0) {
            if (children_a == 0) return false;
            child = static_cast<unsigned>(std::countr_zero(children_a));
            children_a &= children_a - 1;
            // A node against itself: each pair once, and each child against itself.
            const unsigned behind = a == b ? ~0u << child : ~0u;
            waiting = touching(block.node(b), block.node(a).box(child), children_b & behind);
        }
        place = static_cast<unsigned>(std::countr_zero(waiting));
        waiting &= waiting - 1;
        return true;
    }
};

}  // namespace

void join_with_itself(const SceneBlock& block, const OnTouchingBoxes& visit) {
    const BlockHead& head = *block.head;
    if (head.levels == 0) return;
    LeafNodePairs leaves(block, visit);
    const StepsBox all = block.node(head.root).bounds();
    JoinStep path[most_tree_levels];
    std::uint32_t level = head.levels - 1u;
    if (level == 0) leaves.add(head.root, all, head.root, all);
    else path[level] = JoinStep(block, head.root, all, head.root, all);
    while (level != 0 && level != head.levels) {
        JoinStep& step = path[level];
        const BoxNode &a = block.node(step.a), &b = block.node(step.b);
        unsigned place = 0;
        if (!step.take(block, place)) {
            ++level;
            continue;
        }
        const std::uint32_t first = a.child[step.child], second = b.child[place];
        if (level == 1) leaves.add(first, a.box(step.child), second, b.box(place));
        else path[--level] = JoinStep(block, first, a.box(step.child), second, b.box(place));
    }
    leaves.flush();
}

namespace {

/// Some children of a leaf node, against the tree.
struct MarkedChildren {
    const SceneBlock& block;
    const OnTouchingBoxes& visit;
    std::uint32_t node;
    unsigned marks;

    /// Visits what touches them. The walk goes where the box around all of them does.
    void join() const {
        const BoxNode& own = block.node(node);
        StepsBox around = StepsBox::none();
        for (unsigned rest = marks; rest != 0; rest &= rest - 1)
            around.add(own.box(static_cast<unsigned>(std::countr_zero(rest))));
        std::uint32_t waiting[most_tree_levels * (BoxNode::most - 1) + 1];  // 16 * node + level
        unsigned size = 1;
        waiting[0] = 16 * block.head->root + (block.head->levels - 1u);
        while (size != 0) {
            const std::uint32_t level = waiting[--size] % 16, number = waiting[size] / 16;
            const BoxNode& other = block.node(number);
            const unsigned near = touching(other, around);
            if (level == 0) {
                join_with(own, number, other, near);
                continue;
            }
            for (unsigned rest = near; rest != 0; rest &= rest - 1)
                waiting[size++] = 16 * other.child[std::countr_zero(rest)] + (level - 1);
        }
    }

private:
    void join_with(const BoxNode& own, std::uint32_t number, const BoxNode& other, unsigned near) const {
        for (unsigned rest = marks; rest != 0; rest &= rest - 1) {
            const auto child = static_cast<unsigned>(std::countr_zero(rest));
            const unsigned others = number == node ? near & ~(1u << child) : near;
            for (unsigned found = touching(other, own.box(child), others); found != 0; found &= found - 1)
                visit(own.child[child], other.child[std::countr_zero(found)]);
        }
    }
};

}  // namespace

void join_marked_with_all(const SceneBlock& block, const OnTouchingBoxes& visit) {
    for (std::uint32_t node = 0; node < block.head->nodes_used; ++node)
        if (block.dirty[node] != 0) MarkedChildren{block, visit, node, block.dirty[node]}.join();
}
