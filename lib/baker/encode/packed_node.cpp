#include <algorithm>

#include <espalier/format.hpp>

#include <baker/base/byte_writer.hpp>
#include <baker/encode/leaf.hpp>
#include <baker/encode/node.hpp>

namespace espalier::baker {

namespace {

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
    static_assert(255u << format::packed_node::max_shift >= 1u << format::max_bits);
    while (frame.plane_above(hi) > 255) ++frame.shift;
    return frame;
}

Frame put_axis(std::span<const ChildBox> boxes, std::size_t axis, unsigned bits, std::byte* bytes) {
    std::int32_t lo = boxes.front().lo[axis];
    std::int32_t hi = boxes.front().hi[axis];
    for (const ChildBox& box : boxes) {
        lo = std::min(lo, box.lo[axis]);
        hi = std::max(hi, box.hi[axis]);
    }
    const unsigned base_unit = format::unit_shift(bits);
    const Frame frame = frame_for(lo, hi, base_unit);
    set_u16(bytes + (format::packed_node::base_at + 2 * axis), static_cast<std::uint32_t>(frame.base) >> base_unit);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const std::size_t at = format::packed_node::row_bytes * axis + i;
        set_u8(bytes + format::packed_node::lo_at + at, frame.plane_below(boxes[i].lo[axis]));
        set_u8(bytes + format::packed_node::hi_at + at, frame.plane_above(boxes[i].hi[axis]));
    }
    return frame;
}

std::array<Frame, 3> put_boxes(std::span<const ChildBox> boxes, unsigned bits, std::byte* bytes) {
    std::array<Frame, 3> frames;
    std::uint32_t shifts = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        frames[axis] = put_axis(boxes, axis, bits, bytes);
        shifts |= frames[axis].shift << (5 * axis);
    }
    set_u16(bytes + format::packed_node::shifts_at, shifts);
    return frames;
}

void put_leaf_block(const NodeToWrite& from, const std::array<Frame, 3>& frames, std::vector<std::byte>& bytes) {
    using namespace format::strip_leaf;
    const WideNode& node = from.node;
    const bool are_predicted = format::has_predicted_strips(from.profile);
    const std::size_t each = are_predicted ? format::predicted_strip::descriptor_bytes : descriptor_bytes;
    const std::size_t block = bytes.size();
    const std::uint32_t first_triangle = from.wide.leaves[node.first_leaf].first;
    put_u32(bytes, first_triangle);
    bytes.resize(bytes.size() + each * node.leaves);
    const StripBlock written{bytes.size(), first_triangle};
    for (std::uint32_t i = 0; i < node.leaves; ++i) {
        const ChildBox& exact = from.boxes[node.node_children + i];
        LeafBox box;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Frame& frame = frames[axis];
            box.anchor[axis] = frame.coordinate(frame.plane_below(exact.lo[axis]));
            box.side[axis] = frame.coordinate(frame.plane_above(exact.hi[axis])) - box.anchor[axis];
        }
        const std::uint32_t leaf = node.first_leaf + i;
        const std::size_t descriptor_at = block + descriptors_at + each * i;
        if (are_predicted) {
            const std::uint32_t descriptor = put_predicted_strip(from.mesh, from.wide, leaf, box, bytes);
            set_u16(bytes.data() + descriptor_at, descriptor);
        } else {
            const std::uint32_t descriptor = put_strip_leaf(from.mesh, from.wide, leaf, box, written, bytes);
            set_u32(bytes.data() + descriptor_at, descriptor);
        }
    }
    pad_to(bytes, 4);
}

}  // namespace

void put_packed_boxes(std::span<const ChildBox> boxes, unsigned bits, std::byte* bytes) {
    put_boxes(boxes, bits, bytes);
}

void put_packed_node(const NodeToWrite& from, std::byte* bytes, std::vector<std::byte>& leaves) {
    const WideNode& node = from.node;
    const std::array<Frame, 3> frames = put_boxes(from.boxes, from.mesh.lattice.bits, bytes);
    set_u32(bytes + format::packed_node::children_at,
            node.first_child | std::uint32_t{node.node_children} << 24 | std::uint32_t{node.leaves} << 28);
    if (node.leaves == 0) return;
    set_u32(bytes + format::packed_node::leaf_block_at, static_cast<std::uint32_t>(leaves.size() / 4));
    put_leaf_block(from, frames, leaves);
}

}  // namespace espalier::baker
