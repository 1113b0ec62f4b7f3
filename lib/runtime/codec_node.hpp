// A node, decoded: one cache line. The layout is in format.hpp. What comes out is integers on the lattice: boxes as
// base + plane * 2^shift.
#pragma once

#include <cstddef>
#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/as_if_changed.hpp>
#include <runtime/bytes.hpp>
#include <runtime/small_code.hpp>
#include <runtime/step_counter.hpp>

namespace espalier::detail {

/// Where the pieces of a node are.
struct Node {
    const std::byte* bytes;

    [[nodiscard, gnu::always_inline]] std::uint32_t first_child() const {
        return load_u32(bytes + format::node::children_at) & 0xFFFFFFu;
    }
    [[nodiscard]] unsigned node_children() const { return load_u8(bytes + format::node::children_at + 3) & 15u; }
    [[nodiscard]] unsigned leaf_children() const { return load_u8(bytes + format::node::children_at + 3) >> 4; }
    [[nodiscard]] unsigned shift(int axis) const {
        return (load_u16(bytes + format::node::shifts_at) >> (5 * axis)) & 31u;
    }
    [[nodiscard]] std::int32_t base(int axis, unsigned bits) const {
        // mutant(> -> >=) equivalent: both sides are equal then
        // mutant(- -> +) sanitizer: shifts by 32 bits too many, which x86 takes modulo 32
        const unsigned unit = bits > 16 ? bits - 16 : 0;
        const std::byte* at = bytes + (format::node::base_at + 2 * static_cast<std::size_t>(axis));
        return static_cast<std::int32_t>(load_u16(at) << unit);
    }
    [[nodiscard]] const std::byte* low_planes(int axis) const {
        return bytes + format::node::lo_at + 8 * static_cast<std::size_t>(axis);
    }
    [[nodiscard]] const std::byte* high_planes(int axis) const {
        return bytes + format::node::hi_at + 8 * static_cast<std::size_t>(axis);
    }
    [[nodiscard]] std::int32_t plane(int axis, const std::byte* at, unsigned bits) const {
        return base(axis, bits) + static_cast<std::int32_t>(load_u8(at) << shift(axis));
    }
    [[nodiscard]] ESPALIER_SHARED_CODE std::int32_t low(int axis, unsigned child, unsigned bits) const {
        return plane(axis, low_planes(axis) + child, bits);
    }
    [[nodiscard]] ESPALIER_SHARED_CODE std::int32_t high(int axis, unsigned child, unsigned bits) const {
        return plane(axis, high_planes(axis) + child, bits);
    }
    [[nodiscard]] const std::byte* leaf_block(const BlobData& blob) const {
        return blob.leaves + 4 * std::size_t{load_u32(bytes + format::node::leaf_block_at)};
    }
};

/// Which children a node has, read as one word: read apart, its fields cost a walk two more loads and a shift from one
/// node to the next. Small cores read single bytes.
class NodeChildren {
public:
    explicit NodeChildren(Node node) : node_(node) {
        if constexpr (!small_code) word_ = as_if_changed(load_u32(node.bytes + format::node::children_at));
    }
    [[nodiscard]] std::uint32_t first() const { return small_code ? node_.first_child() : word_ & 0xFFFFFFu; }
    /// How many are nodes; the others are leaves.
    [[nodiscard]] unsigned nodes() const { return small_code ? node_.node_children() : word_ >> 24 & 15u; }

private:
    Node node_;
    std::uint32_t word_ = 0;
};

/// A bit for each child.
[[gnu::always_inline]] inline unsigned all_children(const Node& node) {
    return (1u << (node.node_children() + node.leaf_children())) - 1u;
}

inline Node node_at(const BlobData& blob, std::uint32_t index) {
    return {blob.nodes + std::size_t{index} * format::node::bytes};
}

}  // namespace espalier::detail
