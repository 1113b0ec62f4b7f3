// Boxes of a node against integer bounds, with no float and no vector registers: of a packed node eight children at
// once, a byte each. And against a plane that bounds a volume.
#pragma once

#include <bit>
#include <cstdint>

#include <runtime/base/options.hpp>
#include <runtime/blob/node.hpp>

namespace espalier::detail {

/// Lattice steps, both ends included; no more than bounds_limit either way. Where low is above high along an axis no
/// vertex is inside, but something between two lattice planes may be.
struct IntegerBounds {
    std::int32_t low[3];
    std::int32_t high[3];
};

/// Beyond every box that a node can hold, and small enough that differences fit.
inline constexpr std::int32_t bounds_limit = 1 << 26;

constexpr std::int32_t clamp_to_bounds(std::int64_t steps) {
    // mutant(< -> <=, > -> >=) equivalent: both sides are equal then
    return static_cast<std::int32_t>(steps < -bounds_limit  ? -bounds_limit
                                     : steps > bounds_limit ? bounds_limit
                                                            : steps);
}

/// Whether a triangle's corners are all beyond one side of the bounds.
ESPALIER_SHARED_CODE inline bool is_beside(const IntegerBounds& bounds, const std::int32_t (*corner)[3]) {
    for (int k = 0; k < 3; ++k) {
        const std::int32_t a = corner[0][k], b = corner[1][k], c = corner[2][k];
        if (a < bounds.low[k] && b < bounds.low[k] && c < bounds.low[k]) return true;
        if (bounds.high[k] < a && bounds.high[k] < b && bounds.high[k] < c) return true;
    }
    return false;
}

/// The top bit of each of eight bytes, and of each of four words of two bytes.
inline constexpr std::uint64_t byte_tops = 0x8080808080808080u, word_tops = 0x8000800080008000u;

/// The byte, eight times; the word of two bytes, four times.
constexpr std::uint64_t eight_of(std::int32_t byte) { return static_cast<std::uint64_t>(byte) * 0x0101010101010101u; }
constexpr std::uint64_t four_of(std::int32_t word) { return static_cast<std::uint64_t>(word) * 0x0001000100010001u; }

/// Compares the fields of two numbers, as wide as their top bits are apart. In the result, the top bit of a field is
/// set where a's is at least b's; the other bits are unspecified.
template <std::uint64_t tops>
constexpr std::uint64_t fields_at_least(std::uint64_t a, std::uint64_t b) {
    const std::uint64_t low_bits = (a | tops) - (b & ~tops);  // no field borrows from the next
    return (a & ~b) | (~(a ^ b) & low_bits);
}

/// Top bits side by side: that of byte i becomes bit i.
constexpr unsigned byte_tops_of(std::uint64_t bytes) {
    return static_cast<unsigned>(((bytes & byte_tops) >> 7) * 0x0102040810204080u >> 56);
}
/// Returns the highest bits of four words, side by side.
constexpr unsigned word_tops_of(std::uint64_t words) {
    return static_cast<unsigned>(((words & word_tops) >> 15) * 0x0001000200040008u >> 48) & 15u;
}

/// The children for which something holds along every axis, one by one.
template <class Node, class Holds>
inline unsigned children_where(const Node& node, Holds holds) {
    unsigned mask = 0;
    for (unsigned left = all_children(node); left != 0; left &= left - 1) {
        const auto child = static_cast<unsigned>(std::countr_zero(left));
        if (holds(0, child) && holds(1, child) && holds(2, child)) mask |= 1u << child;
    }
    return mask;
}

/// The children whose box meets the bounds, exactly: the bounds are moved into the node's grid once, outward from its
/// planes.
ESPALIER_SHARED_CODE inline unsigned children_within(const PackedNode& node, unsigned bits,
                                                     const IntegerBounds& bounds) {
    std::uint64_t inside = ~std::uint64_t{0};
    for (int k = 0; k < 3; ++k) {
        const std::int32_t base = node.base(k, bits);
        const unsigned shift = node.shift(k);
        const std::int32_t high = (bounds.high[k] - base) >> shift;
        const std::int32_t low = -((base - bounds.low[k]) >> shift);
        if (high < 0 || low > 255) return 0;
        // mutant(< -> <=) equivalent: both sides are equal then
        inside &= fields_at_least<byte_tops>(eight_of(high < 255 ? high : 255), load_u64(node.low_planes(k)));
        // mutant(> -> >=) equivalent: both sides are equal then
        inside &= fields_at_least<byte_tops>(load_u64(node.high_planes(k)), eight_of(low > 0 ? low : 0));
    }
    return byte_tops_of(inside) & all_children(node);
}
ESPALIER_SHARED_CODE inline unsigned children_within(const PlainNode& node, unsigned bits,
                                                     const IntegerBounds& bounds) {
    // On a Cortex-M0, words of 16 planes take a fifth more instructions.
    // mutant(never) work: small code compares words of planes, too, and finds the same children
    if (!takes_shortcut())
        return children_where(node, [&](int k, unsigned child) {
            return node.low(k, child, bits) <= bounds.high[k] && bounds.low[k] <= node.high(k, child, bits);
        });
    const unsigned unit = format::unit_shift(bits);
    std::uint64_t inside[PlainNode::max_children / 4];
    for (std::uint64_t& four : inside) four = ~std::uint64_t{0};
    for (int k = 0; k < 3; ++k) {
        // A high plane stands for all coordinates up to the next one's.
        const std::int32_t high = bounds.high[k] >> unit, low = bounds.low[k] >> unit;
        if (high < 0 || low > 65535) return 0;
        // mutant(< -> <=, > -> >=) equivalent: both sides are equal then
        const std::uint64_t highest = four_of(high < 65535 ? high : 65535), lowest = four_of(low > 0 ? low : 0);
        // mutant(< -> <=) sanitizer: reads or writes behind an array, where a later value belongs
        for (unsigned i = 0; i < PlainNode::max_children / 4; ++i) {
            inside[i] &= fields_at_least<word_tops>(highest, load_u64(node.low_planes(k) + 8 * std::size_t{i}));
            inside[i] &= fields_at_least<word_tops>(load_u64(node.high_planes(k) + 8 * std::size_t{i}), lowest);
        }
    }
    unsigned mask = 0;
    // mutant(< -> <=) sanitizer: reads behind an array; the bits are those of no child
    for (unsigned i = 0; i < PlainNode::max_children / 4; ++i) mask |= word_tops_of(inside[i]) << 4 * i;
    return mask & all_children(node);
}
/// The children whose box is at most that many steps long along every axis; none for a negative number.
ESPALIER_SHARED_CODE inline unsigned children_no_larger(const PackedNode& node, std::int32_t steps, unsigned) {
    if (steps < 0) return 0;
    std::uint64_t small = ~std::uint64_t{0};
    for (int k = 0; k < 3; ++k) {
        // `open` has seen that no low plane is above its high one: no byte borrows.
        const std::uint64_t sides = load_u64(node.high_planes(k)) - load_u64(node.low_planes(k));
        const std::int32_t most = steps >> node.shift(k);
        // mutant(< -> <=) equivalent: both sides are equal then
        small &= fields_at_least<byte_tops>(eight_of(most < 255 ? most : 255), sides);
    }
    return byte_tops_of(small) & all_children(node);
}
ESPALIER_SHARED_CODE inline unsigned children_no_larger(const PlainNode& node, std::int32_t steps, unsigned bits) {
    return children_where(
        node, [&](int k, unsigned child) { return node.high(k, child, bits) - node.low(k, child, bits) <= steps; });
}

/// The half-space dot(normal, x) <= offset, x in lattice steps: at most 2^24 in each coordinate of the normal, 2^62 in
/// the offset.
struct LatticePlane {
    std::int32_t normal[3];
    std::int64_t offset;
};

/// The children, of those in the mask, whose box reaches into the half-space: its corner farthest against the normal
/// does.
inline unsigned children_behind(const PackedNode& node, unsigned bits, const LatticePlane& plane, unsigned mask) {
    std::int64_t room = plane.offset;
    std::int64_t scale[3];
    const std::byte* deepest[3];
    for (int k = 0; k < 3; ++k) {
        const std::int64_t along = plane.normal[k];
        room -= along * node.base(k, bits);
        scale[k] = along * (std::int64_t{1} << node.shift(k));
        // mutant(< -> <=) equivalent: an axis along which the normal is 0 adds nothing from either plane
        deepest[k] = along < 0 ? node.high_planes(k) : node.low_planes(k);
    }
    unsigned behind = 0;
    for (unsigned left = mask; left != 0; left &= left - 1) {
        const auto child = static_cast<unsigned>(std::countr_zero(left));
        std::int64_t reached = 0;
        for (int k = 0; k < 3; ++k) reached += scale[k] * static_cast<std::int64_t>(load_u8(deepest[k] + child));
        behind |= (reached <= room ? 1u : 0u) << child;
    }
    return behind;
}

inline unsigned children_behind(const PlainNode& node, unsigned bits, const LatticePlane& plane, unsigned mask) {
    unsigned behind = 0;
    for (unsigned left = mask; left != 0; left &= left - 1) {
        const auto child = static_cast<unsigned>(std::countr_zero(left));
        std::int64_t reached = 0;
        for (int k = 0; k < 3; ++k) {
            const std::int64_t along = plane.normal[k];
            // mutant(< -> <=) equivalent: an axis along which the normal is 0 adds nothing from either plane
            reached += along * (along < 0 ? node.high(k, child, bits) : node.low(k, child, bits));
        }
        behind |= (reached <= plane.offset ? 1u : 0u) << child;
    }
    return behind;
}

/// Whether the whole box of a child is in the half-space.
template <class Node>
inline bool is_wholly_behind(const Node& node, unsigned bits, unsigned child, const LatticePlane& plane) {
    std::int64_t reached = 0;
    for (int k = 0; k < 3; ++k) {
        const std::int64_t along = plane.normal[k];
        // mutant(< -> <=) equivalent: an axis along which the normal is 0 adds nothing from either plane
        reached += along * (along < 0 ? node.low(k, child, bits) : node.high(k, child, bits));
    }
    return reached <= plane.offset;
}

}  // namespace espalier::detail
