// The way through two trees at once. Included once per instruction set, inside its namespace, after pair_trees.inl.
// At each step the larger of two boxes is replaced by those of its node's children that are worth a visit. A visitor
// offers:
//   unsigned children(unsigned side, const Node&, const TwiceBox& other, float* keys)
//       mask of the children of a node of tree `side` that are worth a visit beside a box of the other tree, and for
//       each how near it is: the nearest goes first, the others in storage order
//   Visit visit_leaves(PairLeaf a, PairLeaf b, const TwiceBox& a_box)      stop ends the walk

/// A node whose children wait, and the box of the other tree that they wait beside.
struct PairLevel {
    static constexpr std::uint32_t side_bit = 1u << 31;
    std::uint32_t node;
    std::uint32_t waiting;  ///< a bit for each child
    std::uint32_t other_and_side;
};

/// `work` is how many pairs may be visited, and then how many are left.
template <class Visitor>
[[gnu::noinline]] QueryStatus traverse_pair(const PairFrame& frame, Visitor& visitor, std::uint64_t& work) {
    PairLevel stack[2 * format::max_depth];
    unsigned depth = 0;
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
            if (depth == 0) return QueryStatus::ok;
            PairLevel& level = stack[depth - 1];
            side = (level.other_and_side & PairLevel::side_bit) != 0 ? 1u : 0u;
            index = level.node;
            mask = level.waiting;
            items[1 - side] = {level.other_and_side & ~PairLevel::side_bit};
            boxes[1 - side] = trees.box(1 - side, items[1 - side]);
            const unsigned rest = mask & (mask - 1);
            level.waiting = rest;
            if (rest == 0) --depth;
            mask ^= rest;
        }
        auto best = static_cast<unsigned>(std::countr_zero(mask));
        // mutant(- -> right side dropped 1) equivalent: compares the best with itself too
        for (unsigned others = mask & (mask - 1); others != 0; others &= others - 1) {
            const auto other = static_cast<unsigned>(std::countr_zero(others));
            best = keys[other] < keys[best] ? other : best;
        }
        // mutant(!= -> true 1) work: pushes an empty set, which is popped again
        if (const unsigned rest = mask & ~(1u << best); rest != 0)
            stack[depth++] = {index, rest, items[1 - side].packed | (side != 0 ? PairLevel::side_bit : 0u)};
        items[side] = trees.child_of(side, index, best);
        boxes[side] = trees.box(side, items[side]);
    }
}
