// The way through two trees at once. Included once per instruction set, inside its namespace.
// At each step the larger of two boxes is replaced by those of its node's children that are worth a visit. A visitor
// offers:
//   unsigned children(unsigned side, const Node&, const TwiceBox& other, float* keys)
//       mask of the children of a node of tree `side` that are worth a visit beside a box of the other tree, and for
//       each how near it is: the nearest goes first, the others in storage order
//   Visit visit_leaves(const LeafPlace& a, const LeafPlace& b)      stop ends the walk
//   static constexpr bool asks_again      whether children are to be asked about again when their turn comes

/// A box of a tree: that of a node's child, or the one around everything.
struct PairItem {
    static constexpr unsigned child_shift = 24;
    static constexpr std::uint32_t leaf_bit = 1u << 27, root_bit = 1u << 28;
    static_assert(format::max_nodes <= 1u << child_shift && format::max_children <= 8);

    std::uint32_t packed = root_bit;

    [[nodiscard]] bool is_leaf() const { return (packed & leaf_bit) != 0; }
    [[nodiscard]] bool is_root() const { return (packed & root_bit) != 0; }
    [[nodiscard]] std::uint32_t parent() const { return packed & ((1u << child_shift) - 1u); }
    [[nodiscard]] unsigned child() const { return packed >> child_shift & 7u; }
};

/// Child `number` of a node, which is a leaf.
struct LeafPlace {
    Node node;
    unsigned number;  ///< among the node's leaves
    TwiceBox box;
};

/// A node whose children wait, and the box of the other tree that they wait beside.
struct PairLevel {
    static constexpr unsigned waiting_shift = 24;
    static constexpr std::uint32_t side_bit = 1u << 31;
    std::uint32_t node_and_waiting;
    std::uint32_t other_and_side;
};

/// `work` is how many pairs may be visited, and then how many are left.
template <class Visitor>
[[gnu::noinline]] QueryStatus traverse_pair(const PairFrame& frame, Visitor& visitor, std::uint64_t& work) {
    PairLevel stack[2 * format::max_depth];
    unsigned depth = 0;
    const BlobData* const blobs[2] = {frame.a, frame.b};
    const float unit[2] = {frame.a_scale, frame.sides[1].common_size};
    PairItem items[2];
    TwiceBox boxes[2];
    const auto load = [&](unsigned side) {
        const PairItem item = items[side];
        const BlobData& blob = *blobs[side];
        if (item.is_root())
            for (int k = 0; k < 3; ++k) boxes[side].center[k] = boxes[side].half[k] = blob.extent_steps[k];
        else boxes[side] = load_twice_box(node_at(blob, item.parent()), item.child(), blob);
    };
    load(0);
    load(1);
    for (;;) {
        if (work == 0) return QueryStatus::work_limit;
        --work;
        unsigned side = 0;
        std::uint32_t index = 0;
        unsigned mask = 0;
        alignas(32) float keys[format::max_children];
        if (items[0].is_leaf() && items[1].is_leaf()) {
            const auto place = [&](unsigned of) {
                const Node node = node_at(*blobs[of], items[of].parent());
                return LeafPlace{node, items[of].child() - node.node_children(), boxes[of]};
            };
            count_leaf_step();
            if (visitor.visit_leaves(place(0), place(1)) == stop) return QueryStatus::ok;
        } else {
            const auto size = [&](unsigned of) {
                return (boxes[of].half[0] + boxes[of].half[1] + boxes[of].half[2]) * unit[of];
            };
            side = items[0].is_leaf() || (!items[1].is_leaf() && size(0) < size(1)) ? 1u : 0u;
            const PairItem item = items[side];
            index = item.is_root() ? 0 : node_at(*blobs[side], item.parent()).first_child() + item.child();
            count_node_step();
            mask = visitor.children(side, node_at(*blobs[side], index), boxes[1 - side], keys);
        }
        while (mask == 0) {
            if (depth == 0) return QueryStatus::ok;
            PairLevel& level = stack[depth - 1];
            side = (level.other_and_side & PairLevel::side_bit) != 0 ? 1u : 0u;
            index = level.node_and_waiting & ((1u << PairLevel::waiting_shift) - 1u);
            mask = level.node_and_waiting >> PairLevel::waiting_shift;
            items[1 - side] = {level.other_and_side & ~PairLevel::side_bit};
            load(1 - side);
            if constexpr (Visitor::asks_again) {
                count_node_step();
                mask &= visitor.children(side, node_at(*blobs[side], index), boxes[1 - side], keys);
                --depth;
            } else {
                const unsigned rest = mask & (mask - 1);
                level.node_and_waiting = index | rest << PairLevel::waiting_shift;
                if (rest == 0) --depth;
                mask ^= rest;
            }
        }
        auto best = static_cast<unsigned>(std::countr_zero(mask));
        for (unsigned others = mask & (mask - 1); others != 0; others &= others - 1) {
            const auto other = static_cast<unsigned>(std::countr_zero(others));
            best = keys[other] < keys[best] ? other : best;
        }
        if (const unsigned rest = mask & ~(1u << best); rest != 0)
            stack[depth++] = {index | rest << PairLevel::waiting_shift,
                              items[1 - side].packed | (side != 0 ? PairLevel::side_bit : 0u)};
        const unsigned node_children = node_at(*blobs[side], index).node_children();
        items[side] = {index | best << PairItem::child_shift | (best >= node_children ? PairItem::leaf_bit : 0u)};
        load(side);
    }
}
