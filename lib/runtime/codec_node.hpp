// What nodes of all kinds share. Each kind offers: `node_children()`, `leaf_children()`, `first_child()`; the boxes of
// its children as `low(axis, child, bits)` and `high(axis, child, bits)`; where the block of its leaves is.
#pragma once

#include <cstddef>
#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/as_if_changed.hpp>
#include <runtime/codec_packed_node.hpp>
#include <runtime/codec_plain_node.hpp>
#include <runtime/small_code.hpp>
#include <runtime/step_counter.hpp>

namespace espalier::detail {

/// Which children a node has, read as one word: read apart, its fields cost a walk two more loads and a shift from one
/// node to the next. Small cores read single bytes.
template <class Node>
class NodeChildren {
public:
    explicit NodeChildren(Node node) : node_(node) {
        if constexpr (!small_code) word_ = as_if_changed(load_u32(node.bytes + Node::children_at));
    }
    [[nodiscard]] std::uint32_t first() const { return small_code ? node_.first_child() : word_ & 0xFFFFFFu; }
    /// How many are nodes; the others are leaves.
    [[nodiscard]] unsigned nodes() const {
        return small_code ? node_.node_children() : Node::node_children_in(word_ >> 24);
    }

private:
    Node node_;
    std::uint32_t word_ = 0;
};

template <class Node>
inline constexpr unsigned every_child_of = (1u << Node::max_children) - 1u;

/// A bit for each child.
template <class Node>
[[gnu::always_inline]] inline unsigned all_children(const Node& node) {
    return (1u << (node.node_children() + node.leaf_children())) - 1u;
}

template <class Node>
inline Node node_at(const BlobData& blob, std::uint32_t index) {
    return {blob.nodes + std::size_t{index} * Node::size};
}

}  // namespace espalier::detail
