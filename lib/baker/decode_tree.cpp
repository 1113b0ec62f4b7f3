#include "decode_tree.hpp"

#include <algorithm>

namespace espalier::baker {

namespace {

std::uint32_t read(std::span<const std::byte> bytes, std::size_t at, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) value |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
    return value;
}

/// Takes fields of any width up to 32 off the front of a stream.
class FieldReader {
public:
    explicit FieldReader(std::span<const std::byte> stream) : stream_(stream) {}

    std::uint32_t next(unsigned width) {
        while (available_ < width) {
            held_ |= std::to_integer<std::uint64_t>(stream_[at_++]) << available_;
            available_ += 8;
        }
        const auto field = static_cast<std::uint32_t>(held_ & ((std::uint64_t{1} << width) - 1));
        held_ >>= width;
        available_ -= width;
        return field;
    }

private:
    std::span<const std::byte> stream_;
    std::size_t at_ = 0;
    std::uint64_t held_ = 0;
    unsigned available_ = 0;
};

}  // namespace

bool DecodedBox::contains(const DecodedBox& other) const {
    bool contained = true;
    for (std::size_t axis = 0; axis < 3; ++axis) contained &= lo[axis] <= other.lo[axis] && other.hi[axis] <= hi[axis];
    return contained;
}

void DecodedBox::add(const DecodedBox& other) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        lo[axis] = std::min(lo[axis], other.lo[axis]);
        hi[axis] = std::max(hi[axis], other.hi[axis]);
    }
}

DecodedBox DecodedLeaf::box() const {
    DecodedBox box{vertices[0], vertices[0]};
    for (unsigned i = 1; i < vertex_count; ++i) box.add({vertices[i], vertices[i]});
    return box;
}

bool TreeBytes::decode_node(std::uint32_t number, DecodedNode& node) const {
    namespace layout = format::node;
    if (number >= nodes.size() / layout::bytes) return false;
    const auto bytes = nodes.subspan(std::size_t{number} * layout::bytes, layout::bytes);
    const std::uint32_t children = read(bytes, layout::children_at, 4);
    node.first_child = children & 0xFFFFFF;
    node.node_children = children >> 24 & 15;
    node.leaves = children >> 28;
    node.leaf_block = read(bytes, layout::leaf_block_at, 4) * 4;
    if (node.children() > format::max_children) return false;
    const std::uint32_t shifts = read(bytes, layout::shifts_at, 2);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::uint32_t base = read(bytes, layout::base_at + 2 * axis, 2) << (bits > 16 ? bits - 16 : 0);
        const unsigned shift = shifts >> (5 * axis) & 31;
        if (shift > layout::max_shift) return false;
        for (std::size_t child = 0; child < node.children(); ++child) {
            const std::size_t at = format::max_children * axis + child;
            node.boxes[child].lo[axis] =
                static_cast<std::int32_t>(base + (read(bytes, layout::lo_at + at, 1) << shift));
            node.boxes[child].hi[axis] =
                static_cast<std::int32_t>(base + (read(bytes, layout::hi_at + at, 1) << shift));
        }
    }
    return true;
}

bool TreeBytes::decode_leaf(const DecodedNode& node, unsigned index, DecodedLeaf& leaf) const {
    namespace layout = format::indexed_leaf;
    const std::size_t data =
        node.leaf_block + layout::descriptors_at + layout::descriptor_bytes * std::size_t{node.leaves};
    if (data > leaves.size()) return false;
    leaf.first_triangle = read(leaves, node.leaf_block, 4);
    std::uint32_t descriptor = 0;
    for (unsigned i = 0; i <= index; ++i) {
        if (i != 0) leaf.first_triangle += leaf.triangle_count;
        descriptor =
            read(leaves, node.leaf_block + layout::descriptors_at + layout::descriptor_bytes * std::size_t{i}, 4);
        leaf.triangle_count = (descriptor >> layout::triangles_shift & 15) + 1;
    }
    leaf.vertex_count = (descriptor >> layout::vertices_shift & 31) + 1;
    leaf.at = data + 2 * std::size_t{descriptor & ((1u << layout::offset_bits) - 1)};

    std::array<unsigned, 3> widths{};
    const unsigned corner_width = layout::corner_width(leaf.vertex_count);
    const std::size_t corner_bytes = layout::stream_bytes(leaf.triangle_count, 3 * corner_width);
    leaf.bytes = corner_bytes;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        widths[axis] = layout::coordinate_width(descriptor >> (layout::widths_shift + 4 * axis) & 15, bits);
        leaf.bytes += layout::stream_bytes(leaf.vertex_count, widths[axis]);
    }
    if (leaf.at > leaves.size() || leaf.bytes > leaves.size() - leaf.at) return false;

    const Coordinates& anchor = node.boxes[node.node_children + index].lo;
    std::size_t at = leaf.at;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t size = layout::stream_bytes(leaf.vertex_count, widths[axis]);
        FieldReader fields(leaves.subspan(at, size));
        for (unsigned i = 0; i < leaf.vertex_count; ++i) {
            leaf.vertices[i][axis] = anchor[axis] + static_cast<std::int32_t>(fields.next(widths[axis]));
        }
        at += size;
    }
    bool is_sound = true;
    FieldReader fields(leaves.subspan(at, corner_bytes));
    for (unsigned i = 0; i < leaf.triangle_count; ++i) {
        for (std::uint32_t& corner : leaf.corners[i]) {
            corner = fields.next(corner_width);
            is_sound &= corner < leaf.vertex_count;
        }
    }
    return is_sound;
}

}  // namespace espalier::baker
