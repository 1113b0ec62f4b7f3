#include "encode_tree.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <span>

#include <espalier/format.hpp>

#include "byte_writer.hpp"
#include "encode_leaf.hpp"

namespace espalier::baker {

namespace {

struct Box {
    std::array<std::int32_t, 3> lo;
    std::array<std::int32_t, 3> hi;
};

Box box_of(const BinaryNode& node) {
    Box box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.lo[axis] = static_cast<std::int32_t>(node.lo[axis]);
        box.hi[axis] = static_cast<std::int32_t>(node.hi[axis]);
    }
    return box;
}

/// The lattice of 8-bit planes on one axis of a node.
struct Frame {
    std::int32_t base;
    unsigned shift;

    [[nodiscard]] std::uint32_t plane_below(std::int32_t coordinate) const {
        return static_cast<std::uint32_t>(coordinate - base) >> shift;
    }
    [[nodiscard]] std::uint32_t plane_above(std::int32_t coordinate) const {
        const auto round_up = (1u << shift) - 1;
        return (static_cast<std::uint32_t>(coordinate - base) + round_up) >> shift;
    }
    [[nodiscard]] std::int32_t coordinate(std::uint32_t plane) const {
        return base + static_cast<std::int32_t>(plane << shift);
    }
};

/// The finest frame in whose 256 planes everything from `lo` to `hi` fits.
Frame frame_for(std::int32_t lo, std::int32_t hi, unsigned base_unit) {
    Frame frame{lo >> base_unit << base_unit, 0};
    static_assert(255u << format::node::max_shift >= 1u << format::max_bits);
    while (frame.plane_above(hi) > 255) ++frame.shift;
    return frame;
}

class TreeEncoder {
public:
    TreeEncoder(const LatticeMesh& mesh, const BinaryTree& tree, const WideTree& wide, EncodedTree& encoded)
        : mesh_(mesh), tree_(tree), wide_(wide), encoded_(encoded), bits_(mesh.lattice.bits) {}

    void encode(std::uint32_t number) {
        const WideNode& node = wide_.nodes[number];
        const unsigned count = unsigned{node.node_children} + node.leaves;
        std::array<Box, format::max_children> boxes;
        std::transform(node.binary_nodes.begin(), node.binary_nodes.begin() + count, boxes.begin(),
                       [&](std::uint32_t binary) { return box_of(tree_.nodes[binary]); });

        std::byte* bytes = encoded_.nodes.data() + std::size_t{number} * format::node::bytes;
        std::array<Frame, 3> frames;
        std::uint32_t shifts = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            frames[axis] = put_axis(std::span(boxes).first(count), axis, bytes);
            shifts |= frames[axis].shift << (5 * axis);
        }
        set_u16(bytes + format::node::shifts_at, shifts);
        set_u32(bytes + format::node::children_at,
                node.first_child | std::uint32_t{node.node_children} << 24 | std::uint32_t{node.leaves} << 28);
        if (node.leaves != 0) {
            set_u32(bytes + format::node::leaf_block_at, static_cast<std::uint32_t>(encoded_.leaves.size() / 4));
            put_leaf_block(node, std::span(boxes).subspan(node.node_children, node.leaves), frames);
        }
        for (std::uint32_t i = 0; i < node.node_children; ++i) encode(node.first_child + i);
    }

private:
    Frame put_axis(std::span<const Box> boxes, std::size_t axis, std::byte* bytes) const {
        std::int32_t lo = boxes.front().lo[axis];
        std::int32_t hi = boxes.front().hi[axis];
        for (const Box& box : boxes) {
            lo = std::min(lo, box.lo[axis]);
            hi = std::max(hi, box.hi[axis]);
        }
        // mutant(> -> >=) equivalent: both sides are equal then
        // mutant(- -> +) sanitizer: shifts by 32 bits too many, which x86 takes modulo 32
        const unsigned base_unit = bits_ > 16 ? bits_ - 16 : 0;
        const Frame frame = frame_for(lo, hi, base_unit);
        set_u16(bytes + (format::node::base_at + 2 * axis), static_cast<std::uint32_t>(frame.base) >> base_unit);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const std::size_t at = format::max_children * axis + i;
            set_u8(bytes + format::node::lo_at + at, frame.plane_below(boxes[i].lo[axis]));
            set_u8(bytes + format::node::hi_at + at, frame.plane_above(boxes[i].hi[axis]));
        }
        return frame;
    }

    void put_leaf_block(const WideNode& node, std::span<const Box> boxes, const std::array<Frame, 3>& frames) {
        using namespace format::plain_leaf;  // blocks of both kinds begin alike
        auto& bytes = encoded_.leaves;
        const std::size_t block = bytes.size();
        put_u32(bytes, wide_.leaves[node.first_leaf].first);
        bytes.resize(bytes.size() + descriptor_bytes * node.leaves);
        LeafBlock written{bytes.size(), wide_.leaves[node.first_leaf].first};
        for (std::uint32_t i = 0; i < node.leaves; ++i) {
            LeafBox box;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const Frame& frame = frames[axis];
                box.anchor[axis] = frame.coordinate(frame.plane_below(boxes[i].lo[axis]));
                box.side[axis] = frame.coordinate(frame.plane_above(boxes[i].hi[axis])) - box.anchor[axis];
            }
            const std::uint32_t leaf = node.first_leaf + i;
            const std::uint32_t descriptor = wide_.strips.empty()
                                                 ? put_plain_leaf(mesh_, wide_, leaf, written, bytes)
                                                 : put_strip_leaf(mesh_, wide_, leaf, box, written, bytes);
            set_u32(bytes.data() + block + descriptors_at + descriptor_bytes * i, descriptor);
        }
        pad_to(bytes, 4);
    }

    const LatticeMesh& mesh_;
    const BinaryTree& tree_;
    const WideTree& wide_;
    EncodedTree& encoded_;
    unsigned bits_;
};

}  // namespace

EncodedTree encode_tree(const LatticeMesh& mesh, const BinaryTree& tree, const WideTree& wide) {
    EncodedTree encoded;
    if (wide.nodes.empty()) return encoded;
    encoded.nodes.resize(wide.nodes.size() * format::node::bytes);
    encoded.leaves.reserve(wide.triangles.size() * 7);
    TreeEncoder(mesh, tree, wide, encoded).encode(0);
    return encoded;
}

}  // namespace espalier::baker
