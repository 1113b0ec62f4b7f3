// Boxes of two trees, as those who walk through both at once keep them.
#ifndef ESPALIER_PAIRS_TREES_HPP
#define ESPALIER_PAIRS_TREES_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/pairs/nodes.hpp>

ESPALIER_BEGIN_SET

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
    friend constexpr bool operator==(const PairLeaf&, const PairLeaf&) = default;
};
inline constexpr PairLeaf no_leaf = {~0u, 0};

/// Inlined, so that it is compiled for the instruction set of the search.
template <class Leaf>
ESPALIER_ALWAYS_INLINE inline void decode_leaf_of_pair(const PairFrame& frame, unsigned side, PairLeaf place,
                                                       Leaf& leaf) {
    const BlobData& blob = frame.blob(side);
    const auto node = node_at<typename Leaf::Node>(blob, place.node);
#if ESPALIER_PREDICTED_STRIPS
    if constexpr (std::is_same_v<Leaf, StripLeaf>)
        if (has_predicted_leaves(blob.profile))
            return decode_predicted_strip(blob, node, place.number, leaf, frame.vertices[side]);
#endif
    decode_leaf(blob, node, place.number, leaf);
}
/// Calls the function with the node of that index.
template <class Function>
ESPALIER_ALWAYS_INLINE inline auto with_node(const BlobData& blob, std::uint32_t index, Function function) {
    return with_leaves_of(blob, [&]<class Leaf>() ESPALIER_ALWAYS_INLINE_LAMBDA {
        return function(node_at<typename Leaf::Node>(blob, index));
    });
}

/// The box that an item stands for.
inline TwiceBox box_of(const PairFrame& frame, unsigned side, PairItem item) {
    const BlobData& blob = frame.blob(side);
    if (!item.is_root())
        return with_node(blob, item.parent(),
                         [&](const auto& node) { return load_twice_box(node, item.child(), blob); });
    TwiceBox whole;
    for (int k = 0; k < 3; ++k) whole.center[k] = whole.half[k] = blob.extent_steps[k];
    return whole;
}
/// The index of the node in an item's box.
inline std::uint32_t node_in(const PairFrame& frame, unsigned side, PairItem item) {
    if (item.is_root()) return 0;
    return with_node(frame.blob(side), item.parent(), [](const auto& node) { return node.first_child(); }) +
           item.child();
}
inline unsigned node_children_of(const PairFrame& frame, unsigned side, std::uint32_t index) {
    return with_node(frame.blob(side), index, [](const auto& node) { return node.node_children(); });
}
inline PairItem child_of(const PairFrame& frame, unsigned side, std::uint32_t node, unsigned child) {
    const bool is_leaf = child >= node_children_of(frame, side, node);
    return {node | child << PairItem::child_shift | (is_leaf ? PairItem::leaf_bit : 0u)};
}
inline PairLeaf leaf_in(const PairFrame& frame, unsigned side, PairItem item) {
    return {item.parent(), item.child() - node_children_of(frame, side, item.parent())};
}

/// Two boxes, one of each tree: a step of a walk. Where stack matters more than time they are loaded again when needed.
class PairOfBoxes {
public:
    PairItem items[2];

    PairOfBoxes(const PairFrame& frame, PairItem a, PairItem b) {
        set(frame, 0, a);
        set(frame, 1, b);
    }
#if ESPALIER_SMALL_CODE
    void set(const PairFrame&, unsigned side, PairItem item) { items[side] = item; }
    void set_again(const PairFrame&, unsigned side, PairItem item) { items[side] = item; }
    [[nodiscard]] TwiceBox box(const PairFrame& frame, unsigned side) const { return box_of(frame, side, items[side]); }
#else
    void set(const PairFrame& frame, unsigned side, PairItem item) {
        items[side] = item;
        boxes_[side] = box_of(frame, side, item);
    }
    /// Sets the box unless it is the one that is there.
    void set_again(const PairFrame& frame, unsigned side, PairItem item) {
        if (items[side].packed != item.packed) set(frame, side, item);
    }
    [[nodiscard]] const TwiceBox& box(const PairFrame&, unsigned side) const { return boxes_[side]; }

private:
    TwiceBox boxes_[2];

public:
#endif
    [[nodiscard]] bool are_leaves() const { return items[0].is_leaf() && items[1].is_leaf(); }
};

/// A box that is replaced by those of its node's children that are worth a visit.
struct OpenedBox {
    unsigned side;
    std::uint32_t node;
    unsigned children;  ///< a bit for each
};
/// The larger one of two boxes that are not both leaves. The visitor is one of walk_pair.
template <class Visitor>
ESPALIER_SHARED_CODE inline OpenedBox open_larger(const PairFrame& frame, const Visitor& visitor, const PairOfBoxes& at,
                                                  float* keys) {
    const TwiceBox& a = at.box(frame, 0);
    const TwiceBox& b = at.box(frame, 1);
    const auto size = [&](const TwiceBox& box, unsigned side) {
        return (box.half[0] + box.half[1] + box.half[2]) * frame.unit(side);
    };
    const unsigned side = at.items[0].is_leaf() || (!at.items[1].is_leaf() && size(a, 0) < size(b, 1)) ? 1u : 0u;
    const std::uint32_t node = node_in(frame, side, at.items[side]);
    count_node_step();
    const unsigned children = with_node(frame.blob(side), node, [&](const auto& opened) {
        return visitor.children(side, opened, side == 0 ? b : a, keys);
    });
    return {side, node, children};
}

/// Two leaves against each other.
template <class Visitor>
ESPALIER_NOINLINE Visit visit_leaf_pair(const PairFrame& frame, Visitor& visitor, const PairOfBoxes& at) {
    count_leaf_step();
    return visitor.visit_leaves(leaf_in(frame, 0, at.items[0]), leaf_in(frame, 1, at.items[1]), at.box(frame, 0));
}

/// The nearest of a node's children that are worth a visit: it is visited first, the others in storage order.
ESPALIER_ALWAYS_INLINE inline unsigned nearest_child(unsigned children, const float* keys) {
    auto nearest = static_cast<unsigned>(std::countr_zero(children));
    // mutant(- -> right side dropped 1) equivalent: compares the nearest with itself too
    for (unsigned others = children & (children - 1); others != 0; others &= others - 1) {
        const auto other = static_cast<unsigned>(std::countr_zero(others));
        nearest = keys[other] < keys[nearest] ? other : nearest;
    }
    return nearest;
}
/// Those that are visited after one of them.
inline unsigned children_after(unsigned child, unsigned children, const float* keys) {
    const unsigned nearest = nearest_child(children, keys);
    const unsigned others = children & ~(1u << nearest);
    return child == nearest ? others : others & ~((2u << child) - 1u);
}

ESPALIER_END_SET

#endif
