#include <baker/verify/decode_tree.hpp>

#include <algorithm>

#include <baker/verify/field_reader.hpp>

namespace espalier::baker {

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

DecodedBox DecodedBox::intersection(const DecodedBox& other) const {
    DecodedBox both;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        both.lo[axis] = std::max(lo[axis], other.lo[axis]);
        both.hi[axis] = std::min(hi[axis], other.hi[axis]);
    }
    return both;
}

DecodedBox DecodedLeaf::box() const {
    DecodedBox box{vertices[0], vertices[0]};
    for (unsigned i = 1; i < vertex_count; ++i) box.add({vertices[i], vertices[i]});
    return box;
}

bool TreeBytes::decode_node(std::uint32_t number, DecodedNode& node) const {
    const std::size_t size = format::node_bytes(profile);
    if (number >= nodes.size() / size) return false;
    const auto bytes = nodes.subspan(number * size, size);
    return profile == Profile::fast ? decode_plain_node(bytes, node) : decode_packed_node(bytes, node);
}

bool TreeBytes::decode_plain_node(std::span<const std::byte> bytes, DecodedNode& node) const {
    namespace layout = format::plain_node;
    node.first_child = read(bytes, layout::children_at, 3);
    node.node_children = read(bytes, layout::children_at + 3, 1);
    node.leaves = read(bytes, layout::leaf_children_at, 1);
    node.leaf_block = read(bytes, layout::leaf_block_at, 4) * 4;
    if (node.children() > layout::max_children) return false;
    const std::uint32_t unit = 1u << (bits > 16 ? bits - 16 : 0);
    for (std::size_t child = 0; child < node.children(); ++child) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t at = 2 * (layout::max_children * axis + child);
            node.boxes[child].lo[axis] = static_cast<std::int32_t>(read(bytes, layout::lo_at + at, 2) * unit);
            node.boxes[child].hi[axis] = static_cast<std::int32_t>((read(bytes, layout::hi_at + at, 2) + 1) * unit - 1);
        }
    }
    for (std::size_t leaf = 0; leaf < node.leaves; ++leaf) {
        node.descriptors[leaf] = read(bytes, layout::leaves_at + 3 * leaf, 3);
    }
    return true;
}

bool TreeBytes::decode_packed_node(std::span<const std::byte> bytes, DecodedNode& node) const {
    namespace layout = format::packed_node;
    const std::uint32_t children = read(bytes, layout::children_at, 4);
    node.first_child = children & 0xFFFFFF;
    node.node_children = children >> 24 & 15;
    node.leaves = children >> 28;
    node.leaf_block = read(bytes, layout::leaf_block_at, 4) * 4;
    if (node.children() > layout::max_children) return false;
    const std::uint32_t shifts = read(bytes, layout::shifts_at, 2);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::uint32_t base = read(bytes, layout::base_at + 2 * axis, 2) << (bits > 16 ? bits - 16 : 0);
        const unsigned shift = shifts >> (5 * axis) & 31;
        if (shift > layout::max_shift) return false;
        for (std::size_t child = 0; child < node.children(); ++child) {
            const std::size_t at = layout::max_children * axis + child;
            node.boxes[child].lo[axis] =
                static_cast<std::int32_t>(base + (read(bytes, layout::lo_at + at, 1) << shift));
            node.boxes[child].hi[axis] =
                static_cast<std::int32_t>(base + (read(bytes, layout::hi_at + at, 1) << shift));
        }
    }
    return true;
}

std::size_t TreeBytes::first_leaf_at(const DecodedNode& node) const {
    if (profile == Profile::fast) return node.leaf_block;
    const std::size_t descriptor_bytes = profile == Profile::tiny ? 2 : 4;
    return node.leaf_block + format::strip_leaf::descriptors_at + descriptor_bytes * node.leaves;
}

bool TreeBytes::decode_leaf(const DecodedNode& node, unsigned index, DecodedLeaf& leaf) const {
    if (profile == Profile::fast) return decode_plain_leaf(node, index, leaf);
    if (profile == Profile::tiny) return decode_predicted_strip(node, index, leaf);
    return decode_strip_leaf(node, index, leaf);
}

}  // namespace espalier::baker
