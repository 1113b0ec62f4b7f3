#include "listing.hpp"

#include <algorithm>
#include <vector>

#include <espalier/format.hpp>

#include <import/base/numbers.hpp>

namespace espalier::tools {

namespace {

/// So many numbers of one width, from where the listing stands.
std::string numbers_text(Bytes bytes, unsigned count, unsigned width, const ByteListing& listing) {
    std::string values;
    for (unsigned i = 0; i < count; ++i) values += text(' ', read_bits(bytes, listing.at() * 8 + i * width, width));
    return values;
}

/// A row of planes for each axis, of `plane_bytes` each.
void list_planes(Bytes bytes, const char* side, unsigned children, std::size_t row_bytes, unsigned plane_bytes,
                 ByteListing& listing) {
    for (const char axis : {'x', 'y', 'z'})
        listing.field(row_bytes, text(side, ' ', axis, numbers_text(bytes, children, 8 * plane_bytes, listing)));
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

/// Fields of one width, low bits first.
void list_numbers(Bytes bytes, const std::string& name, unsigned count, unsigned width, ByteListing& listing) {
    if (width == 0) return;
    listing.field((std::size_t{count} * width + 7) / 8,
                  text(name, ", ", width, " bits:", numbers_text(bytes, count, width, listing)));
}

/// A row of numbers of so many bytes each.
void list_row(Bytes bytes, const char* name, unsigned count, unsigned number_bytes, ByteListing& listing) {
    list_numbers(bytes, text("  ", name), count, 8 * number_bytes, listing);
}

void list_plain_leaf(Bytes bytes, const LeafFields& leaf, const Blob& blob, ByteListing& listing) {
    for (const char* name : {"x", "y", "z"}) list_row(bytes, name, leaf.vertices, 2, listing);
    for (const char* name : {"corner a", "corner b", "corner c"})
        if (!blob.is_deformable()) list_row(bytes, name, leaf.triangles, 1, listing);
    if (!format::plain_leaf::has_high_bytes(detail::data_of(blob).bits)) return;
    for (const char* name : {"x / 65536", "y / 65536", "z / 65536"}) list_row(bytes, name, leaf.vertices, 1, listing);
}

void list_plain_leaves(Bytes bytes, const Blob& blob, const NodeFields& node, std::size_t number,
                       ByteListing& listing) {
    const std::size_t block = listing.at();
    for (unsigned i = 0; i < node.leaves && !listing.full(); ++i) {
        const LeafFields leaf = read_leaf(bytes, blob, node.at, i);
        listing.field_up_to(block + std::size_t{4} * leaf.data_offset, "padding");
        const std::uint32_t triangle = read_u32(bytes, listing.at());
        listing.heading(text("leaf ", i, " of node ", number, ", triangles from ", triangle));
        listing.field(4, text("  first triangle ", triangle));
        list_plain_leaf(bytes, leaf, blob, listing);
    }
}

/// Entries with a star at each pivot, and what triangles they make.
std::string marks_text(const StripMarks& marks) {
    std::string result = "  entries (* pivot)";
    for (std::size_t i = 0; i < marks.entries.size(); ++i) {
        result += text(i == 0 ? ": " : " ", marks.entries[i], marks.pivots[i] ? "*" : "");
    }
    result += "; triangles";
    std::size_t pivot = 0;
    bool keeps_order = false;
    for (std::size_t window = 0; window + 2 < marks.entries.size(); ++window) {
        if (marks.pivots[window]) {
            pivot = window;
            keeps_order = !keeps_order;
        }
        if (!marks.triangles[window]) continue;
        const std::uint32_t one = marks.entries[window + 1], other = marks.entries[window + 2];
        result += text(window == 0 ? ": " : " ", marks.entries[pivot], '-', keeps_order ? one : other, '-',
                       keeps_order ? other : one);
    }
    return result;
}

void list_strip_leaves(Bytes bytes, const Blob& blob, const NodeFields& node, std::size_t number,
                       ByteListing& listing) {
    const std::uint32_t triangle = read_u32(bytes, listing.at());
    listing.field(4, text("leaves of node ", number, ": first triangle ", triangle));
    std::vector<StripFields> fields;
    for (unsigned i = 0; i < node.leaves; ++i) {
        fields.push_back(read_strip(read_u32(bytes, listing.at())));
        const StripFields& leaf = fields.back();
        listing.field(format::strip_leaf::descriptor_bytes,
                      text("leaf ", i, ": data at ", leaf.data_offset, ", ", leaf.entries, " entries, triangles from ",
                           triangle, " + ", leaf.first));
    }
    const std::size_t data = listing.at();
    for (unsigned i = 0; i < node.leaves && !listing.full(); ++i) {
        listing.field_up_to(data + fields[i].data_offset, "padding");
        listing.heading(text("leaf ", i, " of node ", number, ", triangles from ", triangle + fields[i].first));
        const StripMarks marks = read_marks(bytes, listing.at(), fields[i].entries, false);
        listing.field((marks.bits + 7) / 8, marks_text(marks));
        for (unsigned axis = 0; axis < 3; ++axis) {
            const unsigned width = format::strip_leaf::coordinate_width(
                side_of_child(bytes, node.at, node.node_children + i, axis), detail::data_of(blob).bits);
            list_numbers(bytes, text("  ", "xyz"[axis]), marks.vertices, width, listing);
        }
    }
}

/// Widths as "large small" of each axis, and the vertices: those that are not predicted from the box's low corner.
std::string predicted_text(Bytes bytes, std::size_t at, const StripMarks& marks) {
    std::string result = "  residuals, large and small width:";
    for (unsigned axis = 0; axis < 3; ++axis) {
        const std::size_t bit = 8 * at + 2 * format::predicted_strip::width_bits * std::size_t{axis};
        result +=
            text(' ', "xyz"[axis], ' ', read_bits(bytes, bit, format::predicted_strip::width_bits), ' ',
                 read_bits(bytes, bit + format::predicted_strip::width_bits, format::predicted_strip::width_bits));
    }
    return text(result, "; ", marks.vertices, " vertices;", marks_text(marks).substr(1));
}

void list_predicted_strips(Bytes bytes, const NodeFields& node, std::size_t number, ByteListing& listing) {
    std::uint32_t triangle = read_u32(bytes, listing.at());
    listing.field(4, text("leaves of node ", number, ": first triangle ", triangle));
    std::vector<PredictedFields> fields;
    for (unsigned i = 0; i < node.leaves; ++i) {
        fields.push_back(read_predicted_strip(read_u16(bytes, listing.at())));
        listing.field(format::predicted_strip::descriptor_bytes,
                      text("leaf ", i, ": ", fields.back().bytes, " bytes, ", fields.back().entries, " entries"));
    }
    for (unsigned i = 0; i < node.leaves && !listing.full(); ++i) {
        listing.heading(text("leaf ", i, " of node ", number, ", triangles from ", triangle));
        const StripMarks marks = read_marks(bytes, listing.at(), fields[i].entries, true);
        listing.field(fields[i].bytes, predicted_text(bytes, listing.at(), marks));
        triangle += static_cast<std::uint32_t>(std::count(marks.triangles.begin(), marks.triangles.end(), true));
    }
}

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
    listing.field(std::size_t{count} * bits / 8, text(name, ':', numbers_text(bytes, count, bits, listing)));
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

void list_leaf_block(Bytes bytes, const Blob& blob, std::size_t node, ByteListing& listing) {
    const NodeFields fields = read_node(bytes, blob, node);
    if (format::has_plain_nodes(blob.profile())) {
        list_plain_leaves(bytes, blob, fields, node, listing);
    } else if (format::has_predicted_strips(blob.profile())) {
        list_predicted_strips(bytes, fields, node, listing);
    } else {
        list_strip_leaves(bytes, blob, fields, node, listing);
    }
}

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
