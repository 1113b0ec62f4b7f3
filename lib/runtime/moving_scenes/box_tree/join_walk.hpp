// The tree over moving instances, or the boxes of some slots, against the tree: one box at a time against the eight of
// a node.
#ifndef ESPALIER_MOVING_SCENES_BOX_TREE_JOIN_WALK_HPP
#define ESPALIER_MOVING_SCENES_BOX_TREE_JOIN_WALK_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/moving_scenes/box_tree/self_join.hpp>

ESPALIER_BEGIN_SET

namespace {

/// Counts nothing.
struct Uncounted {
    void box_test() const {}
    void pairs(unsigned) const {}
};
/// Counts the work of a walk.
struct Counted {
    SceneCounters* counters;
    void box_test() const { ++counters->box_tests; }
    void pairs(unsigned count) const { counters->pairs += count; }
};

/// Returns which of some children of a node touch a box, a bit for each. A place without a child has an empty box.
ESPALIER_ALWAYS_INLINE inline unsigned touching(const BoxNode& node, const StepsBox& box, unsigned among) {
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
    return eight_that_touch(node.low, node.high, box.low, box.high) & among;
}

/// The box of a child, against the children of a node.
struct Comparison {
    std::uint32_t place;  ///< 8 * node + child
    std::uint32_t node;
};

/// The comparisons that wait, in a queue for each step on the way to the leaf nodes. A queue is carried out many at a
/// time: none waits for what another finds, and no branch depends on it. For each child of the node that touches the
/// box, what is below the box waits to be compared with that child. Or the box itself, where one side alone descends.
template <bool both_descend, class Counting>
class QueuedJoin {
public:
    QueuedJoin(const SceneBlock& block, const OnTouchingBoxes& visit, Counting counting)
        : block_(block),
          visit_(visit),
          counting_(counting),
          top_((both_descend ? 2u : 1u) * (block.head->levels - 1u)) {}

    /// Compares a child of some node with the whole tree, at once or later.
    ESPALIER_ALWAYS_INLINE void add(std::uint32_t place) {
        waiting_[top_][count_[top_]++] = {place, block_.head->root};
        if (count_[top_] >= chunk) carry_out(top_);
    }
    /// Carries out what waits.
    void finish() {
        for (unsigned step = top_ + 1; step-- != 0;) carry_out(step);
    }

private:
    static constexpr unsigned all_children = (1u << BoxNode::most) - 1;
    static constexpr unsigned chunk = 64;
    static constexpr unsigned most_steps = (both_descend ? 2u : 1u) * (most_tree_levels - 1u) + 1u;

    /// Carries out all that waits at a step, and as much of what that adds to the steps below as needs the room.
    ESPALIER_NOINLINE void carry_out(unsigned top) {
        for (unsigned step = top;;) {
            if (step == 0) {
                visit_touching();
            } else if (descend(step); count_[step - 1] >= chunk) {
                --step;
                continue;
            }
            do {
                if (++step > top) return;
            } while (count_[step] == 0);
        }
    }

    /// Carries out comparisons of a step until none waits, or the step below is full.
    ESPALIER_ALWAYS_INLINE void descend(unsigned step) {
        unsigned waiting = count_[step], below = count_[step - 1];
        Comparison* const out = waiting_[step - 1];
        while (waiting != 0 && below < chunk) {
            const auto [place, second] = waiting_[step][--waiting];
            const BoxNode &a = block_.node(place / 8), &b = block_.node(second);
            const unsigned children = touching(b, a.box(place % 8), children_below(place, second));
            counting_.box_test();
            if constexpr (both_descend) below += put_marked(out + below, 8 * second, a.child[place % 8], children);
            else below += put_with_marked(out + below, place, b.child, children);
        }
        count_[step] = waiting;
        count_[step - 1] = below;
    }
    /// Returns which children of the second node count: of a node against itself each pair once, and each child
    /// against itself.
    ESPALIER_ALWAYS_INLINE static unsigned children_below(std::uint32_t place, std::uint32_t second) {
        return both_descend && place / 8 == second ? all_children & ~0u << place % 8 : all_children;
    }
    /// Returns which children of the second leaf node count: of a node against itself no child against itself.
    ESPALIER_ALWAYS_INLINE static unsigned others(std::uint32_t place, std::uint32_t second) {
        const unsigned own = 1u << place % 8;
        return place / 8 != second ? all_children : all_children & (both_descend ? 0u - 2 * own : ~own);
    }

    /// Visits the pairs that the comparisons with leaf nodes find.
    ESPALIER_ALWAYS_INLINE void visit_touching() {
        unsigned found[chunk + BoxNode::most], size = 0;
        for (unsigned i = 0; i < count_[0]; ++i) {
            const auto [place, second] = waiting_[0][i];
            const unsigned children =
                touching(block_.node(second), block_.node(place / 8).box(place % 8), others(place, second));
            counting_.box_test();
            found[size] = i << BoxNode::most | children;
            size += children != 0 ? 1u : 0u;
        }
        InstancePair pairs[chunk + BoxNode::most];
        unsigned count = 0;
        for (unsigned i = 0; i < size; ++i) {
            const auto [place, second] = waiting_[0][found[i] >> BoxNode::most];
            count += put_with_marked(pairs + count, block_.node(place / 8).child[place % 8], block_.node(second).child,
                                     found[i] & all_children);
            if (count >= chunk) visit(pairs, count);
        }
        visit(pairs, count);
        count_[0] = 0;
    }
    void visit(const InstancePair* pairs, unsigned& count) {
        counting_.pairs(count);
        visit_({pairs, count});
        count = 0;
    }

    const SceneBlock& block_;
    const OnTouchingBoxes& visit_;
    [[no_unique_address]] const Counting counting_;
    const unsigned top_;
    unsigned count_[most_steps] = {};
    Comparison waiting_[most_steps][chunk + BoxNode::most];
};

/// Compares the box of a slot with the tree.
template <class Counting>
ESPALIER_ALWAYS_INLINE inline void join_one(const SceneBlock& block, std::uint32_t slot, const OnTouchingBoxes& visit,
                                            Counting counting) {
    const StepsBox& box = block.slots[slot].box;
    std::uint32_t waiting[most_tree_levels * (BoxNode::most - 1) + 1];  // 16 * node + level
    unsigned size = 1;
    waiting[0] = 16 * block.head->root + (block.head->levels - 1u);
    while (size != 0) {
        const std::uint32_t number = waiting[--size], level = number % 16;
        const BoxNode& node = block.node(number / 16);
        counting.box_test();
        for (unsigned rest = touching(node, box, (1u << BoxNode::most) - 1); rest != 0; rest &= rest - 1) {
            const std::uint32_t child = node.child[std::countr_zero(rest)];
            if (level != 0) {
                waiting[size++] = 16 * child + (level - 1);
            } else if (child != slot) {
                const InstancePair pair = {slot, child};
                counting.pairs(1);
                visit({&pair, 1});
            }
        }
    }
}

template <class Counting>
ESPALIER_ALWAYS_INLINE inline void join_counting(const SceneBlock& block, JoinedSlots joined, std::uint32_t slot,
                                                 const OnTouchingBoxes& visit, Counting counting) {
    const BlockHead& head = *block.head;
    if (head.levels == 0) return;
    if (joined == JoinedSlots::one) return join_one(block, slot, visit, counting);
    if constexpr (!small_code) {  // pairs of small cores are found slot by slot
        if (joined == JoinedSlots::all) {
            QueuedJoin<true, Counting> join(block, visit, counting);
            for (unsigned child = 0; child < BoxNode::most; ++child) join.add(8 * head.root + child);
            return join.finish();
        }
        QueuedJoin<false, Counting> join(block, visit, counting);
        for (std::uint32_t i = 0; i < head.slots_used; ++i)
            if (has_moved(block, i) && is_live(block.slots[i])) join.add(block.slots[i].place);
        join.finish();
    }
}

}  // namespace

ESPALIER_QUERY_OF_SET void join(const SceneBlock& block, JoinedSlots joined, std::uint32_t slot,
                                const OnTouchingBoxes& visit) {
    join_counting(block, joined, slot, visit, Uncounted{});
}

ESPALIER_END_SET

#endif
