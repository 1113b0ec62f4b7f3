// The walk through two trees at once. At each step the larger of two boxes is replaced by those of its node's children
// that are worth a visit. A visitor offers:
//   unsigned children(unsigned side, const Node&, const TwiceBox& other, float* keys)
//       mask of the children of a node of tree `side` that are worth a visit beside a box of the other tree, and for
//       each how near it is: the nearest goes first, the others in storage order
//   Visit visit_leaves(PairLeaf a, PairLeaf b, const TwiceBox& a_box)      stop ends the walk
#ifndef ESPALIER_PAIRS_WALK_HPP
#define ESPALIER_PAIRS_WALK_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/pairs/trees.hpp>

ESPALIER_BEGIN_SET

// What a walk has still to visit: the children that wait at each step on the way down. One of the two for each machine.

/// The nodes whose children wait, each with the box of the other tree beside it, in nine bytes a level.
class PairLevels {
public:
    /// The step from two boxes to a child of one of them, beside which others wait.
    void push(const OpenedBox& opened, unsigned, unsigned waiting, const PairOfBoxes& at) {
        if (waiting == 0) return;
        node_[size_] = opened.node;
        other_and_side_[size_] = at.items[1 - opened.side].packed | (opened.side != 0 ? side_bit : 0u);
        set_waiting(size_++, waiting);
    }
    /// To the pair that the next of those that wait makes. False when there is none.
    bool take_waiting(const PairFrame& frame, PairOfBoxes& at) {
        if (size_ == 0) return false;
        const unsigned level = size_ - 1;
        const unsigned all = waiting_[level] | node_[level] >> node_bits << 8, rest = all & (all - 1);
        const unsigned side = (other_and_side_[level] & side_bit) != 0 ? 1u : 0u;
        const std::uint32_t node = node_[level] & ((1u << node_bits) - 1u);
        at.set_again(frame, 1 - side, {other_and_side_[level] & ~side_bit});
        at.set(frame, side, child_of(frame, side, node, static_cast<unsigned>(std::countr_zero(all))));
        set_waiting(level, rest);
        if (rest == 0) --size_;
        return true;
    }

private:
    static constexpr std::uint32_t side_bit = 1u << 31;
    static constexpr unsigned node_bits = 24;
    static constexpr unsigned most = 2 * format::max_depth;
    static_assert(format::max_nodes <= 1u << node_bits && format::max_children <= 16);

    void set_waiting(unsigned level, unsigned children) {
        waiting_[level] = static_cast<std::uint8_t>(children);
        node_[level] = (node_[level] & ((1u << node_bits) - 1u)) | children >> 8 << node_bits;
    }

    std::uint32_t node_[most];  ///< and above it the last eight of the children that wait
    std::uint32_t other_and_side_[most];
    std::uint8_t waiting_[most];  ///< the first eight
    unsigned size_ = 0;
};

/// The steps that led to a pair of boxes, in two or four bytes each. Does not store the nodes on its way but finds them
/// again from the roots.
class PairPath {
public:
    void push(const OpenedBox& opened, unsigned child, unsigned waiting, const PairOfBoxes&) {
        steps_[size_++] = packed(opened.side, child, waiting);
    }
    ESPALIER_NOINLINE bool take_waiting(const PairFrame& frame, PairOfBoxes& at) {
        for (; size_ != 0 && waiting_at(size_ - 1) == 0; --size_) {
        }
        if (size_ == 0) return false;
        const unsigned waiting = waiting_at(size_ - 1);
        steps_[size_ - 1] =
            packed(side_at(size_ - 1), static_cast<unsigned>(std::countr_zero(waiting)), waiting & (waiting - 1));
        at.items[0] = at.items[1] = {};
        for (unsigned i = 0; i < size_; ++i) {
            const unsigned side = side_at(i);
            at.set(frame, side, child_of(frame, side, node_in(frame, side, at.items[side]), child_at(i)));
        }
        return true;
    }

private:
    static constexpr unsigned most_children = reads_plain_leaves ? PlainNode::max_children : PackedNode::max_children;
    using Step = std::conditional_t<most_children <= 8, std::uint16_t, std::uint32_t>;
    static constexpr unsigned child_shift = most_children;
    static constexpr unsigned side_shift = child_shift + std::bit_width(most_children - 1);
    static_assert(side_shift < 8 * sizeof(Step));
    static Step packed(unsigned side, unsigned child, unsigned waiting) {
        return static_cast<Step>(side << side_shift | child << child_shift | waiting);
    }
    [[nodiscard]] unsigned side_at(unsigned i) const { return steps_[i] >> side_shift; }
    [[nodiscard]] unsigned child_at(unsigned i) const { return steps_[i] >> child_shift & (most_children - 1); }
    [[nodiscard]] unsigned waiting_at(unsigned i) const { return steps_[i] & ((1u << most_children) - 1u); }

    Step steps_[2 * format::max_depth];
    unsigned size_ = 0;
};

using PairStack = std::conditional_t<small_code, PairPath, PairLevels>;

/// From two boxes to the nearest that one of them is replaced by. False when there is none.
template <class Visitor>
ESPALIER_SHARED_CODE inline bool step_down(const PairFrame& frame, const Visitor& visitor, PairOfBoxes& at,
                                           PairStack& stack) {
    alignas(wide_register_alignment) float keys[format::max_children];
    const OpenedBox opened = open_larger(frame, visitor, at, keys);
    if (opened.children == 0) return false;
    const unsigned best = nearest_child(opened.children, keys);
    stack.push(opened, best, opened.children & ~(1u << best), at);
    at.set(frame, opened.side, child_of(frame, opened.side, opened.node, best));
    return true;
}

/// The way that a walk takes to the two leaves that hold a pair of triangles. invalid_argument if no walk comes there.
template <class Visitor>
ESPALIER_NOINLINE QueryStatus find_leaves_of(const TrianglePair& pair, const PairFrame& frame, const Visitor& visitor,
                                             PairOfBoxes& at, PairStack& stack, std::uint64_t& work) {
    while (!at.are_leaves()) {
        if (work == 0) return QueryStatus::work_limit;
        --work;
        alignas(wide_register_alignment) float keys[format::max_children];
        const OpenedBox opened = open_larger(frame, visitor, at, keys);
        const TriangleId triangle = opened.side == 0 ? pair.a : pair.b;
        const unsigned child = child_holding(frame.blob(opened.side), opened.node, triangle.index);
        if ((opened.children >> child & 1u) == 0) return QueryStatus::invalid_argument;
        stack.push(opened, child, children_after(child, opened.children, keys), at);
        at.set(frame, opened.side, child_of(frame, opened.side, opened.node, child));
    }
    return QueryStatus::ok;
}

/// From the roots on, or from the leaves that hold a pair of triangles. `work` is how many pairs of boxes may be
/// visited, and then how many are left.
template <class Visitor>
ESPALIER_NOINLINE QueryStatus walk_pair(const PairFrame& frame, Visitor& visitor, const TrianglePair* from,
                                        std::uint64_t& work) {
    PairStack stack;
    PairOfBoxes at(frame, {}, {});
    if (from != nullptr) {
        const QueryStatus status = find_leaves_of(*from, frame, visitor, at, stack, work);
        if (status != QueryStatus::ok) return status;
    }
    for (;;) {
        if (work == 0) return QueryStatus::work_limit;
        --work;
        if (!at.are_leaves()) {
            if (step_down(frame, visitor, at, stack)) continue;
        } else if (visit_leaf_pair(frame, visitor, at) == Visit::stop) {
            return QueryStatus::ok;
        }
        if (!stack.take_waiting(frame, at)) return QueryStatus::ok;
    }
}

ESPALIER_END_SET

#endif
