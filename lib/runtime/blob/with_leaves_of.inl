// The kinds of leaf, and the leaf of a node, handed to a function.
#ifndef ESPALIER_IN_INSTRUCTION_SET  // parsed alone
#include <runtime/blob/alone.hpp>
#endif

/// Calls the function for the kind of leaf that the blob has.
template <class Function>
[[gnu::always_inline]] inline auto with_leaves_of(const BlobData& blob, Function function) {
    if constexpr (!reads_strip_leaves) return function.template operator()<PlainLeaf>();
    else if constexpr (!reads_plain_leaves) return function.template operator()<StripLeaf>();
    else if (has_plain_leaves(blob.profile)) return function.template operator()<PlainLeaf>();
    else return function.template operator()<StripLeaf>();
}

#if ESPALIER_PREDICTED_STRIPS
/// Calls the function with a predicted strip. Apart from its caller, whose frame has no room for vertices.
template <class Function>
[[gnu::noinline]] inline auto with_predicted_strip(const BlobData& blob, PackedNode node, unsigned number,
                                                   Function& function) {
    StripLeaf leaf;
    PredictedVertices vertices;
    decode_predicted_strip(blob, node, number, leaf, vertices);
    return function(static_cast<const StripLeaf&>(leaf));
}
#endif

/// Calls the function with the leaf of a kind that is child `node.node_children() + number` of the node.
template <class Leaf, class Function>
[[gnu::always_inline]] inline auto with_leaf(const BlobData& blob, typename Leaf::Node node, unsigned number,
                                             Function function) {
#if ESPALIER_PREDICTED_STRIPS
    if constexpr (std::is_same_v<Leaf, StripLeaf>)
        if (has_predicted_leaves(blob.profile)) return with_predicted_strip(blob, node, number, function);
#endif
    return function(static_cast<const Leaf&>(leaf_at<Leaf>(blob, node, number)));
}

/// Has the visitor visit the leaf that is child `node.node_children() + number` of the node.
template <class Leaf, class Visitor>
[[gnu::always_inline]] inline Visit visit_leaf(const BlobData& blob, typename Leaf::Node node, unsigned number,
                                               Visitor& visitor) {
    return with_leaf<Leaf>(
        blob, node, number, [&](const Leaf& leaf) __attribute__((always_inline)) { return visitor.visit_leaf(leaf); });
}
