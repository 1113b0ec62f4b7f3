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
/// Returns which children touch it. A place without a child has an empty box.
[[gnu::always_inline]] inline unsigned touching(const BoxNode& node, const StepsBox& box) {
    return touching(node, box, (1u << BoxNode::most) - 1);
}

/// A child of a leaf node, against the children of another or the same one.
struct ChildAgainstNode {
    std::uint32_t place;  ///< 8 * node + child
    std::uint32_t node;
};

/// The pairs of leaf nodes that a walk finds, which are compared in chunks: in each chunk nothing waits for a branch
/// that no processor could foresee.
class LeafNodePairs {
public:
    /// `skips_lower`: of two children of one node only the pair with the lower one first counts.
    LeafNodePairs(const SceneBlock& block, const OnTouchingBoxes& visit, bool skips_lower)
        : block_(block), visit_(visit), skips_lower_(skips_lower) {}

    /// Adds a pair of leaf nodes. Of the first only the children count that touch the second one's box.
    [[gnu::always_inline]] void add(std::uint32_t a, std::uint32_t b, const StepsBox& box_b) {
        const unsigned children = touching(block_.node(a), box_b);
        for (unsigned child = 0; child < BoxNode::most; ++child) {
            waiting_[count_] = {8 * a + child, b};
            count_ += children >> child & 1u;
        }
        if (count_ >= chunk) flush();
    }
    /// Adds some children of a leaf node, against all of another.
    [[gnu::always_inline]] void add_some(std::uint32_t a, unsigned children, std::uint32_t b) {
        for (; children != 0; children &= children - 1)
            waiting_[count_++] = {8 * a + static_cast<unsigned>(std::countr_zero(children)), b};
        if (count_ >= chunk) flush();
    }
    /// Visits the pairs of children of what was added.
    [[gnu::noinline]] void flush() {
        unsigned found[chunk + BoxNode::most], size = 0;
        for (unsigned i = 0; i < count_; ++i) {
            const auto [place, node] = waiting_[i];
            const unsigned own = 1u << place % 8, in_same = skips_lower_ ? 0u - 2 * own : ~own;
            const unsigned others = (place / 8 == node ? in_same : ~0u) & ((1u << BoxNode::most) - 1);
            const unsigned children = touching(block_.node(node), block_.node(place / 8).box(place % 8), others);
            found[size] = i << BoxNode::most | children;
            size += children != 0 ? 1u : 0u;
        }
        for (unsigned i = 0; i < size; ++i) {
            const auto [place, node] = waiting_[found[i] >> BoxNode::most];
            const std::uint32_t first = block_.node(place / 8).child[place % 8];
            for (unsigned rest = found[i] & ((1u << BoxNode::most) - 1); rest != 0; rest &= rest - 1)
                visit_(first, block_.node(node).child[std::countr_zero(rest)]);
        }
        count_ = 0;
    }

private:
    static constexpr unsigned chunk = small_code ? 8 : 64;

    const SceneBlock& block_;
    const OnTouchingBoxes& visit_;
    const bool skips_lower_;
    unsigned count_ = 0;
    ChildAgainstNode waiting_[chunk + BoxNode::most];
};

/// Two nodes above the leaf nodes, and which of their children are still to be visited.
struct JoinStep {
    std::uint32_t a, b;
    unsigned children;  ///< those of a that touch b, without the one at hand
    unsigned child;     ///< of a, at hand
    unsigned waiting;   ///< children of b that touch it

    JoinStep() = default;
    /// The box of the second is given.
    [[gnu::always_inline]] JoinStep(const SceneBlock& block, std::uint32_t first, std::uint32_t second,
                                    const StepsBox& box_of_second)
        : a(first), b(second), children(touching(block.node(first), box_of_second)), child(0), waiting(0) {}

    /// Returns whether there is a next pair of children, and takes it from those that wait.
    [[gnu::always_inline]] bool take(const SceneBlock& block, unsigned& place) {
        while (waiting == 0) {
            if (children == 0) return false;
            child = static_cast<unsigned>(std::countr_zero(children));
            children &= children - 1;
            waiting = touching(block.node(b), block.node(a).box(child));
            // A node against itself: each pair once, and each child against itself.
            if (a == b) waiting &= ~0u << child;
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
    LeafNodePairs leaves(block, visit, true);
    const StepsBox all = block.node(head.root).bounds();
    JoinStep path[most_tree_levels];
    std::uint32_t level = head.levels - 1u;
    if (level == 0) leaves.add(head.root, head.root, all);
    else path[level] = JoinStep(block, head.root, head.root, all);
    while (level != 0 && level != head.levels) {
        JoinStep& step = path[level];
        const BoxNode &a = block.node(step.a), &b = block.node(step.b);
        unsigned place = 0;
        if (!step.take(block, place)) {
            ++level;
            continue;
        }
        const std::uint32_t first = a.child[step.child], second = b.child[place];
        if (level == 1) leaves.add(first, second, b.box(place));
        else path[--level] = JoinStep(block, first, second, b.box(place));
    }
    leaves.flush();
}

namespace {

/// Adds the pairs of a leaf node's marked children with the leaf nodes that the box around them touches.
[[gnu::always_inline]] inline void add_marked(const SceneBlock& block, std::uint32_t node, LeafNodePairs& leaves) {
    const unsigned marks = block.dirty[node];
    StepsBox around = StepsBox::none();
    for (unsigned rest = marks; rest != 0; rest &= rest - 1)
        around.add(block.node(node).box(static_cast<unsigned>(std::countr_zero(rest))));
    std::uint32_t waiting[most_tree_levels * (BoxNode::most - 1) + 2];  // 16 * node + level
    unsigned size = 1;
    waiting[0] = 16 * block.head->root + (block.head->levels - 1u);
    while (size != 0) {
        const std::uint32_t level = waiting[--size] % 16;
        const BoxNode& other = block.node(waiting[size] / 16);
        if (level == 0) {  // the root
            leaves.add_some(node, marks, block.head->root);
            return;
        }
        unsigned near = touching(other, around);
        for (; level == 1 && near != 0; near &= near - 1)
            leaves.add_some(node, marks, other.child[std::countr_zero(near)]);
        // Without a branch that no processor could foresee.
        for (unsigned i = 0; i < BoxNode::most; ++i) {
            waiting[size] = 16 * other.child[i] + (level - 1);
            size += near >> i & 1u;
        }
    }
}

}  // namespace

void join_marked_with_all(const SceneBlock& block, const OnTouchingBoxes& visit) {
    LeafNodePairs leaves(block, visit, false);
    for (std::uint32_t node = 0; node < block.head->nodes_used; ++node)
        if (block.dirty[node] != 0) add_marked(block, node, leaves);
    leaves.flush();
}
