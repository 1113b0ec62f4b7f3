// Boxes of two trees, as those who walk through both at once keep them. Included once per instruction set, inside its
// namespace, after pair_nodes.inl.

/// A box of a tree: that of a node's child, or the one around everything.
struct PairItem {
    static constexpr unsigned child_shift = 24;
    static constexpr std::uint32_t leaf_bit = 1u << 28, root_bit = 1u << 29;
    static_assert(format::max_nodes <= 1u << child_shift && format::max_children <= 16);

    std::uint32_t packed = root_bit;

    [[nodiscard]] bool is_leaf() const { return (packed & leaf_bit) != 0; }
    [[nodiscard]] bool is_root() const { return (packed & root_bit) != 0; }
    [[nodiscard]] std::uint32_t parent() const { return packed & ((1u << child_shift) - 1u); }
    [[nodiscard]] unsigned child() const { return packed >> child_shift & 15u; }
};

/// Where a leaf of one of the trees is.
struct PairLeaf {
    std::uint32_t node;
    unsigned number;  ///< among the node's leaves
};
template <class Leaf>
inline Leaf leaf_of_pair(const PairFrame& frame, unsigned side, PairLeaf place) {
    const BlobData& blob = side == 0 ? *frame.a : *frame.b;
    const auto node = node_at<typename Leaf::Node>(blob, place.node);
#if ESPALIER_PREDICTED_STRIPS
    if constexpr (std::is_same_v<Leaf, StripLeaf>) {
        if (has_predicted_leaves(blob.profile)) {
            StripLeaf leaf;
            decode_predicted_strip(blob, node, place.number, leaf, frame.vertices[side]);
            return leaf;
        }
    }
#endif
    return leaf_at<Leaf>(blob, node, place.number);
}
/// Calls the function with the node of that index.
template <class Function>
[[gnu::always_inline]] inline auto with_node(const BlobData& blob, std::uint32_t index, Function function) {
    return with_leaves_of(
        blob, [&]<class Leaf>()
                  __attribute__((always_inline)) { return function(node_at<typename Leaf::Node>(blob, index)); });
}

/// What items stand for, in either tree.
struct PairTrees {
    const BlobData* blob[2];
    float unit[2];  ///< of a lattice, on the common grid

    explicit PairTrees(const PairFrame& frame)
        : blob{frame.a, frame.b}, unit{frame.a_scale, frame.sides[1].common_size} {}

    [[nodiscard]] TwiceBox box(unsigned side, PairItem item) const {
        if (!item.is_root())
            return with_node(*blob[side], item.parent(),
                             [&](const auto& node) { return load_twice_box(node, item.child(), *blob[side]); });
        TwiceBox whole;
        for (int k = 0; k < 3; ++k) whole.center[k] = whole.half[k] = blob[side]->extent_steps[k];
        return whole;
    }
    /// The side whose box goes on: the larger one, while it is no leaf.
    [[nodiscard]] unsigned side_to_open(const PairItem* items, const TwiceBox* boxes) const {
        const auto size = [&](unsigned side) {
            return (boxes[side].half[0] + boxes[side].half[1] + boxes[side].half[2]) * unit[side];
        };
        return items[0].is_leaf() || (!items[1].is_leaf() && size(0) < size(1)) ? 1u : 0u;
    }
    /// The index of the node in an item's box.
    [[nodiscard]] std::uint32_t node_in(unsigned side, PairItem item) const {
        if (item.is_root()) return 0;
        return with_node(*blob[side], item.parent(), [](const auto& node) { return node.first_child(); }) +
               item.child();
    }
    [[nodiscard]] PairItem child_of(unsigned side, std::uint32_t node, unsigned child) const {
        const bool is_leaf = child >= node_children(side, node);
        return {node | child << PairItem::child_shift | (is_leaf ? PairItem::leaf_bit : 0u)};
    }
    [[nodiscard]] PairLeaf leaf(unsigned side, PairItem item) const {
        return {item.parent(), item.child() - node_children(side, item.parent())};
    }

private:
    [[nodiscard]] unsigned node_children(unsigned side, std::uint32_t index) const {
        return with_node(*blob[side], index, [](const auto& node) { return node.node_children(); });
    }
};

/// A box that is replaced by those of its node's children that are worth a visit.
struct OpenedBox {
    unsigned side;
    std::uint32_t node;
    unsigned children;  ///< a bit for each
};
/// The larger one of two boxes that are not both leaves. The visitor is one of traverse_pair.
template <class Visitor>
ESPALIER_SHARED_CODE inline OpenedBox open_larger(const PairFrame& frame, const Visitor& visitor, const PairItem* items,
                                                  float* keys) {
    const PairTrees trees(frame);
    const TwiceBox boxes[2] = {trees.box(0, items[0]), trees.box(1, items[1])};
    const unsigned side = trees.side_to_open(items, boxes);
    const std::uint32_t node = trees.node_in(side, items[side]);
    count_node_step();
    const unsigned children = with_node(*trees.blob[side], node, [&](const auto& opened) {
        return visitor.children(side, opened, boxes[1 - side], keys);
    });
    return {side, node, children};
}

/// Two leaves against each other.
template <class Visitor>
ESPALIER_SHARED_CODE inline Visit visit_leaf_pair(const PairFrame& frame, Visitor& visitor, const PairItem* items) {
    const PairTrees trees(frame);
    count_leaf_step();
    return visitor.visit_leaves(trees.leaf(0, items[0]), trees.leaf(1, items[1]), trees.box(0, items[0]));
}
