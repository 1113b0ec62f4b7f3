// A node of profile `fast`: numbers in whole bytes, which lanes load as they are. The layout is in format.hpp. What
// comes out is integers on the lattice.
#pragma once

#include <cstddef>
#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/bytes.hpp>
#include <runtime/node_bytes.hpp>
#include <runtime/small_code.hpp>

namespace espalier::detail {

/// Where the pieces of a node are.
struct PlainNode : NodeBytes<format::plain_node::children_at, format::plain_node::leaf_block_at,
                             format::plain_node::lo_at, format::plain_node::hi_at, format::plain_node::row_bytes> {
    static constexpr unsigned max_children = format::plain_node::max_children;
    static constexpr std::size_t size = format::plain_node::bytes;

    [[nodiscard]] unsigned node_children() const { return load_u8(bytes + children_at + 3); }
    [[nodiscard]] unsigned leaf_children() const { return load_u8(bytes + format::plain_node::leaf_children_at); }
    /// From the byte behind the number of the first child.
    static constexpr unsigned node_children_in(std::uint32_t counts) { return counts; }
    [[nodiscard]] ESPALIER_SHARED_CODE std::int32_t low(int axis, unsigned child, unsigned bits) const {
        return static_cast<std::int32_t>(load_u16(low_planes(axis) + 2 * std::size_t{child})
                                         << format::unit_shift(bits));
    }
    [[nodiscard]] ESPALIER_SHARED_CODE std::int32_t high(int axis, unsigned child, unsigned bits) const {
        const std::uint32_t next = load_u16(high_planes(axis) + 2 * std::size_t{child}) + 1;
        return static_cast<std::int32_t>((next << format::unit_shift(bits)) - 1);
    }
    /// How the leaf of that number is coded, in 24 bits; above them lies what follows in the node.
    [[nodiscard]] std::uint32_t leaf_descriptor(unsigned number) const {
        return load_u32(bytes + format::plain_node::leaves_at + format::plain_leaf::descriptor_bytes * number);
    }
};

}  // namespace espalier::detail
