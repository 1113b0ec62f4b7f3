#include "motion_listing.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "base/numbers.hpp"

namespace espalier::tools {

namespace {

using Bytes = std::span<const std::byte>;

struct Leaf {
    std::size_t node;
    unsigned number;  ///< among the leaves of the node
    std::uint32_t first_triangle;
    LeafFields fields;

    [[nodiscard]] std::string name() const { return text("leaf ", number, " of node ", node); }
};

/// In the order of their nodes' numbers.
std::vector<Leaf> leaves_of(Bytes bytes, const Blob& blob) {
    const std::size_t leaves_at = section_named(sections_of(blob), "leaves").at;
    std::vector<Leaf> leaves;
    for (std::size_t number = 0; number < detail::data_of(blob).node_count; ++number) {
        const NodeFields node = read_node(bytes, blob, number);
        for (unsigned i = 0; i < node.leaves; ++i) {
            const LeafFields fields = read_leaf(bytes, blob, node.at, i);
            const std::size_t at = leaves_at + std::size_t{4} * node.leaf_block + std::size_t{4} * fields.data_offset;
            leaves.push_back({number, i, read_u32(bytes, at), fields});
        }
    }
    return leaves;
}

/// The next `count` numbers as one field.
void list_motion_row(Bytes bytes, const std::string& name, unsigned count, unsigned bits, ByteListing& listing) {
    std::string values;
    for (unsigned i = 0; i < count; ++i) values += text(' ', read_bits(bytes, listing.at() * 8 + i * bits, bits));
    listing.field(std::size_t{count} * bits / 8, text(name, ':', values));
}

}  // namespace

void list_corners(Bytes bytes, const Blob& blob, const Section& section, ByteListing& listing) {
    std::vector<Leaf> leaves = leaves_of(bytes, blob);
    std::sort(leaves.begin(), leaves.end(),
              [](const Leaf& a, const Leaf& b) { return a.first_triangle < b.first_triangle; });
    for (const Leaf& leaf : leaves) {
        if (listing.full()) return;
        listing.heading(text(leaf.name(), ", triangles from ", leaf.first_triangle));
        for (const char* corner : {"  corner a", "  corner b", "  corner c"})
            list_motion_row(bytes, corner, leaf.fields.triangles, 8, listing);
    }
    listing.field_up_to(section.at + section.bytes - format::corners::guard_bytes, "padding");
    listing.field(format::corners::guard_bytes, "zeros, so that wide loads stay inside");
}

void list_vertex_sources(Bytes bytes, const Blob& blob, const Section& section, ByteListing& listing) {
    const unsigned bits = vertex_source_bits(blob);
    for (const Leaf& leaf : leaves_of(bytes, blob)) {
        if (listing.full()) return;
        list_motion_row(bytes, text("positions of ", leaf.name()), leaf.fields.vertices, bits, listing);
    }
    listing.field_up_to(section.at + section.bytes, "padding");
}

}  // namespace espalier::tools
