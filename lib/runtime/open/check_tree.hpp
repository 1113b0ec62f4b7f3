// One pass over the nodes of a tree, which proves that they are one.
#pragma once

#include <cstddef>
#include <cstdint>

#include <espalier/blob.hpp>
#include <espalier/status.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/blob/node.hpp>
#include <runtime/open/checks.hpp>

namespace espalier::detail {

/// A box for each child. There is at least one, and there are no more than a node holds.
[[maybe_unused]] inline bool has_sound_boxes(const PackedNode& node, unsigned children, const BlobData&) {
    using namespace format::packed_node;
    if (load_u16(node.bytes + shifts_at) >> 15 != 0) return false;
    for (unsigned shifts = load_u16(node.bytes + shifts_at); shifts != 0; shifts >>= 5)
        if ((shifts & 31u) > max_shift) return false;
    for (unsigned plane = 0; plane < 3 * max_children; ++plane) {
        const std::uint32_t low = load_u8(node.bytes + lo_at + plane);
        const std::uint32_t high = load_u8(node.bytes + hi_at + plane);
        if (low > high || (plane % max_children >= children && high != 0)) return false;
    }
    return true;
}
[[maybe_unused]] inline bool has_sound_boxes(const PlainNode& node, unsigned children, const BlobData& blob) {
    using namespace format::plain_node;
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t most = static_cast<std::uint32_t>(blob.extent[k]) >> format::unit_shift(blob.bits);
        for (unsigned child = 0; child < max_children; ++child) {
            const std::uint32_t low = load_u16(node.low_planes(k) + 2 * std::size_t{child});
            const std::uint32_t high = load_u16(node.high_planes(k) + 2 * std::size_t{child});
            if (low > high || high > (child < children ? most : 0)) return false;
        }
    }
    return is_zero(node.bytes + reserved_at, bytes - reserved_at);
}

/// Visits every node exactly once, children after their parents, in depth-first order with a stack as deep as the
/// format allows. `blocks.next()` returns where the leaves of the next node that has any must begin;
/// `blocks.take(node)` checks them, and returns ok or a reason.
template <class Node, class Blocks>
OpenStatus check_tree(const BlobData& blob, Blocks& blocks) {
    struct Siblings {
        std::uint32_t next;
        std::uint32_t end;
    };
    Siblings stack[format::max_depth + 1];
    std::uint32_t seen_nodes = 1;  // the root, then every block of siblings when their parent is reached
    unsigned seen_depth = 0;
    unsigned depth = 1;
    stack[1 - 1] = {0, 1};
    while (depth != 0) {
        Siblings& siblings = stack[depth - 1];
        if (siblings.next == siblings.end) {
            --depth;
            continue;
        }
        if (depth > blob.depth) return OpenStatus::bad_node;
        // mutant(> -> >=) equivalent: both sides are equal then
        seen_depth = depth > seen_depth ? depth : seen_depth;
        const auto node = node_at<Node>(blob, siblings.next++);
        const unsigned nodes = node.node_children();
        const unsigned leaves = node.leaf_children();
        const unsigned children = nodes + leaves;
        if (children == 0 || children > Node::max_children || !has_sound_boxes(node, children, blob) ||
            node.first_child() != (nodes == 0 ? 0 : seen_nodes) || nodes > blob.node_count - seen_nodes ||
            node.leaf_block_place() != (leaves == 0 ? 0 : blocks.next()))
            return OpenStatus::bad_node;
        if (const OpenStatus status = blocks.take(node); status != OpenStatus::ok) return status;
        stack[depth++] = {seen_nodes, seen_nodes + nodes};
        seen_nodes += nodes;
    }
    return seen_nodes == blob.node_count && seen_depth == blob.depth ? OpenStatus::ok : OpenStatus::bad_node;
}

}  // namespace espalier::detail
