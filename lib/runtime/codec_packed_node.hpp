// A node of profiles `balanced` and `small`, decoded: one cache line. The layout is in format.hpp. What comes out is
// integers on the lattice: boxes as base + plane * 2^shift.
#pragma once

#include <cstddef>
#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/bytes.hpp>
#include <runtime/node_bytes.hpp>
#include <runtime/small_code.hpp>

namespace espalier::detail {

/// Where the pieces of a node are.
struct PackedNode : NodeBytes<format::packed_node::children_at, format::packed_node::leaf_block_at,
                              format::packed_node::lo_at, format::packed_node::hi_at, format::packed_node::row_bytes> {
    static constexpr unsigned max_children = format::packed_node::max_children;
    static constexpr std::size_t size = format::packed_node::bytes;

    [[nodiscard]] unsigned node_children() const { return node_children_in(load_u8(bytes + children_at + 3)); }
    [[nodiscard]] unsigned leaf_children() const { return load_u8(bytes + children_at + 3) >> 4; }
    /// From the byte behind the number of the first child.
    static constexpr unsigned node_children_in(std::uint32_t counts) { return counts & 15u; }
    [[nodiscard]] unsigned shift(int axis) const {
        return (load_u16(bytes + format::packed_node::shifts_at) >> (5 * axis)) & 31u;
    }
    [[nodiscard]] std::int32_t base(int axis, unsigned bits) const {
        const std::byte* at = bytes + (format::packed_node::base_at + 2 * static_cast<std::size_t>(axis));
        return static_cast<std::int32_t>(load_u16(at) << format::unit_shift(bits));
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
};

}  // namespace espalier::detail
