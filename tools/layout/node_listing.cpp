#include "node_listing.hpp"

#include <string>

#include <espalier/format.hpp>

#include "base/numbers.hpp"

namespace espalier::tools {

namespace {

using Bytes = std::span<const std::byte>;

/// A row of planes for each axis, of `plane_bytes` each.
void list_planes(Bytes bytes, const char* side, unsigned children, std::size_t row_bytes, std::size_t plane_bytes,
                 ByteListing& listing) {
    for (const char axis : {'x', 'y', 'z'}) {
        std::string planes;
        for (std::size_t i = 0; i < children; ++i) {
            const std::size_t at = listing.at() + plane_bytes * i;
            planes += text(' ', plane_bytes == 1 ? read_u8(bytes, at) : read_u16(bytes, at));
        }
        listing.field(row_bytes, text(side, ' ', axis, planes));
    }
}

void list_plain_node(Bytes bytes, const Blob& blob, std::size_t number, ByteListing& listing) {
    namespace field = format::plain_node;
    const NodeFields node = read_node(bytes, blob, number);
    const unsigned children = node.node_children + node.leaves;
    listing.heading(text("node ", number));
    list_planes(bytes, "low", children, field::row_bytes, 2, listing);
    list_planes(bytes, "high", children, field::row_bytes, 2, listing);
    listing.field(4, text("first child node ", node.first_child, ", ", node.node_children, " node children"));
    listing.field(4, text("leaf block at 4 x ", node.leaf_block));
    for (unsigned i = 0; i < node.leaves; ++i) {
        const LeafFields leaf = read_leaf(bytes, blob, node.at, i);
        listing.field(
            format::plain_leaf::descriptor_bytes,
            text("leaf ", i, ": data at 4 x ", leaf.data_offset, " of the block, ", counted(leaf.triangles, "triangle"),
                 ", ", counted(leaf.vertices, "vertex"), ", size below 2^", leaf.size_bits));
    }
    listing.field_up_to(node.at + field::leaf_children_at, "no more leaves");
    listing.field(1, text(node.leaves, " leaves"));
    listing.field_up_to(node.at + field::bytes, "reserved");
}

}  // namespace

void list_packed_node(Bytes bytes, const NodeFields& node, std::size_t number, const PackedNodeWords& words,
                      ByteListing& listing) {
    namespace field = format::packed_node;
    const unsigned children = node.node_children + node.leaves;
    const auto base = [&](unsigned axis) { return read_u16(bytes, node.at + field::base_at + 2 * axis); };
    const auto shift = [&](unsigned axis) { return read_shift(bytes, node.at, axis); };
    listing.field(6, text("node ", number, ": base ", base(0), ' ', base(1), ' ', base(2)));
    listing.field(2, text("shifts ", shift(0), ' ', shift(1), ' ', shift(2)));
    listing.field(4, text("first child node ", node.first_child, ", ", node.node_children, " node children, ",
                          node.leaves, ' ', words.leaves));
    listing.field(4, text(words.leaf_block, node.leaf_block));
    list_planes(bytes, "low", children, field::row_bytes, 1, listing);
    list_planes(bytes, "high", children, field::row_bytes, 1, listing);
}

void list_nodes(Bytes bytes, const Blob& blob, ByteListing& listing) {
    const bool has_plain_nodes = format::has_plain_nodes(blob.profile());
    for (std::size_t node = 0; node < detail::data_of(blob).node_count && !listing.full(); ++node) {
        if (has_plain_nodes) list_plain_node(bytes, blob, node, listing);
        else list_packed_node(bytes, read_node(bytes, blob, node), node, {"leaves", "leaf block at 4 x "}, listing);
    }
}

}  // namespace espalier::tools
