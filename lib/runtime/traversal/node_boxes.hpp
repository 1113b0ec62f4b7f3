// Boxes of a node in lanes, in lattice steps: exactly, for every kind of node.
#ifndef ESPALIER_TRAVERSAL_NODE_BOXES_HPP
#define ESPALIER_TRAVERSAL_NODE_BOXES_HPP

#include <runtime/lanes/set.hpp>

ESPALIER_BEGIN_SET

/// The boxes of a packed node, whose planes count from its base.
struct PackedBoxes {
    PackedNode node;
    Frame frame;

    [[nodiscard]] ESPALIER_ALWAYS_INLINE Floats low(int k, unsigned first) const {
        return multiply_add(bytes_to_floats(node.low_planes(k) + first), frame.scale[k], frame.base[k]);
    }
    [[nodiscard]] ESPALIER_ALWAYS_INLINE Floats high(int k, unsigned first) const {
        return multiply_add(bytes_to_floats(node.high_planes(k) + first), frame.scale[k], frame.base[k]);
    }
};
ESPALIER_ALWAYS_INLINE inline PackedBoxes boxes_of(const PackedNode& node, const BlobData& blob) {
    return {node, load_frame(node, blob)};
}

/// The boxes of a plain node, whose planes are coordinates, in larger units on fine lattices. Cores without a float
/// unit keep them as integers until the end, so they convert once and multiply nothing.
struct PlainBoxes {
    PlainNode node;
    float unit;
    unsigned bits;

    [[nodiscard]] ESPALIER_ALWAYS_INLINE Floats low(int k, unsigned first) const {
        if constexpr (!has_square_root) return whole(node.low(k, first, bits));
        else return multiply(to_floats(load_words(node.low_planes(k) + 2 * std::size_t{first})), splat(unit));
    }
    [[nodiscard]] ESPALIER_ALWAYS_INLINE Floats high(int k, unsigned first) const {
        if constexpr (!has_square_root) return whole(node.high(k, first, bits));
        else
            return multiply_add(to_floats(load_words(node.high_planes(k) + 2 * std::size_t{first})), splat(unit),
                                splat(unit - 1.0f));
    }

private:
    /// Converts a coordinate, which has no sign: that takes fewer instructions.
    ESPALIER_ALWAYS_INLINE static Floats whole(std::int32_t coordinate) {
        return splat(static_cast<float>(static_cast<std::uint32_t>(coordinate)));
    }
};
ESPALIER_ALWAYS_INLINE inline PlainBoxes boxes_of(const PlainNode& node, const BlobData& blob) {
    return {node, blob.base_unit, blob.bits};
}

ESPALIER_END_SET

#endif
