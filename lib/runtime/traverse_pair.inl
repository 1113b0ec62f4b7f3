// The way through two trees at once. Included once per instruction set, inside its namespace, after pair_trees.inl.
// At each step the larger of two boxes is replaced by those of its node's children that are worth a visit. A visitor
// offers:
//   unsigned children(unsigned side, const Node&, const TwiceBox& other, float* keys)
//       mask of the children of a node of tree `side` that are worth a visit beside a box of the other tree, and for
//       each how near it is: the nearest goes first, the others in storage order
//   Visit visit_leaves(PairLeaf a, PairLeaf b, const TwiceBox& a_box)      stop ends the walk

/// The nodes whose children wait, each with the box of the other tree beside it, in nine bytes of stack a level.
class PairLevels {
public:
    [[nodiscard]] bool is_empty() const { return size_ == 0; }
    void push(unsigned side, std::uint32_t node, unsigned children, PairItem other) {
        node_[size_] = node;
        other_and_side_[size_] = other.packed | (side != 0 ? side_bit : 0u);
        set_waiting(size_++, children);
    }
    [[nodiscard]] unsigned side() const { return (other_and_side_[size_ - 1] & side_bit) != 0 ? 1u : 0u; }
    [[nodiscard]] std::uint32_t node() const { return node_[size_ - 1] & ((1u << node_bits) - 1u); }
    [[nodiscard]] PairItem other() const { return {other_and_side_[size_ - 1] & ~side_bit}; }
    /// The next child that waits at the last level, as a mask; when it is the last one, the level is gone.
    unsigned take_child() {
        const unsigned level = size_ - 1;
        const unsigned all = waiting_[level] | node_[level] >> node_bits << 8, rest = all & (all - 1);
        set_waiting(level, rest);
        if (rest == 0) --size_;
        return all ^ rest;
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

/// `work` is how many pairs may be visited, and then how many are left.
template <class Visitor>
[[gnu::noinline]] QueryStatus traverse_pair(const PairFrame& frame, Visitor& visitor, std::uint64_t& work) {
    PairLevels levels;
    const PairTrees trees(frame);
    PairItem items[2];
    TwiceBox boxes[2] = {trees.box(0, items[0]), trees.box(1, items[1])};
    for (;;) {
        if (work == 0) return QueryStatus::work_limit;
        --work;
        unsigned side = 0;
        std::uint32_t index = 0;
        unsigned mask = 0;
        alignas(wide_register_alignment) float keys[format::max_children];
        if (items[0].is_leaf() && items[1].is_leaf()) {
            count_leaf_step();
            if (visitor.visit_leaves(trees.leaf(0, items[0]), trees.leaf(1, items[1]), boxes[0]) == stop)
                return QueryStatus::ok;
        } else {
            side = trees.side_to_open(items, boxes);
            index = trees.node_in(side, items[side]);
            count_node_step();
            mask = with_node(*trees.blob[side], index,
                             [&](const auto& node) { return visitor.children(side, node, boxes[1 - side], keys); });
        }
        while (mask == 0) {
            if (levels.is_empty()) return QueryStatus::ok;
            side = levels.side();
            index = levels.node();
            items[1 - side] = levels.other();
            boxes[1 - side] = trees.box(1 - side, items[1 - side]);
            mask = levels.take_child();
        }
        auto best = static_cast<unsigned>(std::countr_zero(mask));
        // mutant(- -> right side dropped 1) equivalent: compares the best with itself too
        for (unsigned others = mask & (mask - 1); others != 0; others &= others - 1) {
            const auto other = static_cast<unsigned>(std::countr_zero(others));
            best = keys[other] < keys[best] ? other : best;
        }
        // mutant(!= -> true 1) work: pushes an empty set, which is popped again
        if (const unsigned rest = mask & ~(1u << best); rest != 0) levels.push(side, index, rest, items[1 - side]);
        items[side] = trees.child_of(side, index, best);
        boxes[side] = trees.box(side, items[side]);
    }
}
