// The nodes of a tree. The children of a node are numbered, nodes before leaves. Its node children are contiguous, and
// such blocks of siblings are in depth-first order. Boxes are rounded outward.
#pragma once

#include <cstddef>
#include <cstdint>

#include <espalier/format/header.hpp>

namespace espalier::format {

/// Returns the exponent of the unit, 2^unit_shift lattice steps, in which a packed node counts its base and a plain
/// node its planes.
// mutant(> -> >=) equivalent: both sides are equal then
constexpr unsigned unit_shift(unsigned bits) { return bits > 16 ? bits - 16 : 0; }

/// Profiles balanced, small and tiny: a node is one cache line. The planes of a child's box are base + plane * 2^shift
/// along each axis.
namespace packed_node {
inline constexpr unsigned max_children = 8;
inline constexpr std::size_t base_at = 0;      // 3 x u16, in units of 2^unit_shift
inline constexpr std::size_t shifts_at = 6;    // u16: 5 bits each for x, y and z, then a zero bit
inline constexpr std::size_t children_at = 8;  // u32: 24 bits first child node, 4 bits node children, 4 bits leaves
inline constexpr std::size_t leaf_block_at =
    12;  // u32, in units of 4 bytes from the start of the leaf section; 0 without leaves
inline constexpr std::size_t lo_at = 16;     // u8 [axis][child]
inline constexpr std::size_t hi_at = 40;     // u8 [axis][child]
inline constexpr std::size_t row_bytes = 8;  // the planes along one axis
inline constexpr std::size_t bytes = 64;
inline constexpr unsigned max_shift = 17;
static_assert(hi_at + 3 * row_bytes == bytes);
}  // namespace packed_node

/// Profile fast: every number takes whole bytes, so that SIMD lanes can load it. Along each axis, a child's box extends
/// from lo * 2^unit_shift to (hi + 1) * 2^unit_shift - 1.
namespace plain_node {
inline constexpr unsigned max_children = 16;
inline constexpr std::size_t lo_at = 0;            // u16 [axis][child]
inline constexpr std::size_t hi_at = 96;           // u16 [axis][child]
inline constexpr std::size_t row_bytes = 32;       // the planes along one axis
inline constexpr std::size_t children_at = 192;    // u32: 24 bits first child node, 8 bits number of node children
inline constexpr std::size_t leaf_block_at = 196;  // u32, in units of 4 bytes from the start of the leaf section
inline constexpr std::size_t leaves_at = 200;      // u24 for each leaf: its descriptor, see `plain_leaf`; otherwise 0
inline constexpr std::size_t leaf_children_at = 248;  // u8
inline constexpr std::size_t reserved_at = 249;       // zeros to the end
inline constexpr std::size_t bytes = 256;
static_assert(hi_at == 3 * row_bytes && children_at == 6 * row_bytes && row_bytes == 2 * max_children);
}  // namespace plain_node

constexpr bool has_plain_nodes(Profile profile) { return profile == Profile::fast; }
constexpr unsigned max_node_children(Profile profile) {
    return has_plain_nodes(profile) ? plain_node::max_children : packed_node::max_children;
}
constexpr std::size_t node_bytes(Profile profile) {
    return has_plain_nodes(profile) ? plain_node::bytes : packed_node::bytes;
}
static_assert(plain_node::max_children == max_children && packed_node::max_children <= max_children);

}  // namespace espalier::format
