// The walk through two trees with little stack: the steps of traverse_pair.inl, in one word a level. It does not store
// the nodes on its way but finds them again from the roots. Included after pair_trees.inl.

/// The steps that led to a pair of boxes.
class PairPath {
public:
    void step(unsigned side, unsigned child, unsigned waiting) { steps_[size_++] = packed(side, child, waiting); }

    /// To the box that waits at the last step where one does: the pair that it makes. False when none waits.
    [[gnu::noinline]] bool take_waiting(const PairFrame& frame, PairItem* items) {
        for (; size_ != 0 && waiting_at(size_ - 1) == 0; --size_) {
        }
        if (size_ == 0) return false;
        const unsigned waiting = waiting_at(size_ - 1);
        steps_[size_ - 1] =
            packed(side_at(size_ - 1), static_cast<unsigned>(std::countr_zero(waiting)), waiting & (waiting - 1));
        const PairTrees trees(frame);
        items[0] = items[1] = {};
        for (unsigned i = 0; i < size_; ++i) {
            PairItem& item = items[side_at(i)];
            item = trees.child_of(side_at(i), trees.node_in(side_at(i), item), child_at(i));
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

/// From a pair of boxes to the nearest that one of them is replaced by. False when there is none.
template <class Visitor>
[[gnu::noinline]] bool step_down(const PairFrame& frame, const Visitor& visitor, PairItem* items, PairPath& path) {
    float keys[format::max_children];
    const OpenedBox opened = open_larger(frame, visitor, items, keys);
    if (opened.children == 0) return false;
    auto best = static_cast<unsigned>(std::countr_zero(opened.children));
    for (unsigned others = opened.children; others != 0; others &= others - 1) {
        const auto other = static_cast<unsigned>(std::countr_zero(others));
        best = keys[other] < keys[best] ? other : best;
    }
    path.step(opened.side, best, opened.children & ~(1u << best));
    items[opened.side] = PairTrees(frame).child_of(opened.side, opened.node, best);
    return true;
}

template <class Visitor>
[[gnu::noinline]] QueryStatus traverse_pair(const PairFrame& frame, Visitor& visitor, std::uint64_t& work) {
    PairPath path;
    PairItem items[2];
    for (;;) {
        if (work == 0) return QueryStatus::work_limit;
        --work;
        if (!items[0].is_leaf() || !items[1].is_leaf()) {
            if (step_down(frame, visitor, items, path)) continue;
        } else if (visit_leaf_pair(frame, visitor, items) == stop) {
            return QueryStatus::ok;
        }
        if (!path.take_waiting(frame, items)) return QueryStatus::ok;
    }
}
