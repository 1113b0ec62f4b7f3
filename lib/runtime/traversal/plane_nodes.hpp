// Boxes of a node against a plane that bounds a volume, in integers.
#pragma once

#include <bit>
#include <cstdint>

#include <runtime/traversal/box_nodes.hpp>

namespace espalier::detail {

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

/// Whether the whole box of a child is that deep in the half-space.
template <class Node>
inline bool is_wholly_behind(const Node& node, unsigned bits, unsigned child, const LatticePlane& plane,
                             std::int64_t depth) {
    std::int64_t reached = 0;
    for (int k = 0; k < 3; ++k) {
        const std::int64_t along = plane.normal[k];
        // mutant(< -> <=) equivalent: an axis along which the normal is 0 adds nothing from either plane
        reached += along * (along < 0 ? node.low(k, child, bits) : node.high(k, child, bits));
    }
    return reached <= plane.offset - depth;
}

}  // namespace espalier::detail
