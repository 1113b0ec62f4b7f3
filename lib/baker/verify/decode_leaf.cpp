#include <algorithm>

#include <baker/verify/decode_tree.hpp>
#include <baker/verify/field_reader.hpp>

namespace espalier::baker {

bool TreeBytes::decode_plain_leaf(const DecodedNode& node, unsigned index, DecodedLeaf& leaf) const {
    namespace layout = format::plain_leaf;
    const std::uint32_t descriptor = node.descriptors[index];
    leaf.triangle_count = (descriptor >> layout::triangles_shift & 15) + 1;
    leaf.vertex_count = (descriptor >> layout::vertices_shift & 31) + 1;
    leaf.at = node.leaf_block + 4 * std::size_t{descriptor & ((1u << layout::offset_bits) - 1)};

    // The first triangle; three rows of words, three of corners unless these lie apart, and on a lattice of more than
    // 16 bits three of the bytes above the words.
    const std::size_t words = leaf.at + 4;
    const std::size_t after_words = words + 6 * std::size_t{leaf.vertex_count};
    const std::size_t bytes_above = after_words + (corners ? 0 : 3 * std::size_t{leaf.triangle_count});
    const std::size_t end = bytes_above + (bits > 16 ? 3 * std::size_t{leaf.vertex_count} : 0);
    leaf.bytes = end - leaf.at;
    if (end > leaves.size()) return false;
    leaf.first_triangle = read(leaves, leaf.at, 4);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < leaf.vertex_count; ++i) {
            const std::size_t place = axis * leaf.vertex_count + i;
            const std::uint32_t above = bits > 16 ? read(leaves, bytes_above + place, 1) : 0;
            leaf.vertices[i][axis] = static_cast<std::int32_t>(read(leaves, words + 2 * place, 2) | above << 16);
        }
    }
    const std::span<const std::byte> corner_bytes = corners.value_or(leaves);
    const std::size_t corners_at = corners ? 3 * std::size_t{leaf.first_triangle} : after_words;
    if (corners_at + 3 * std::size_t{leaf.triangle_count} > corner_bytes.size()) return false;
    bool is_sound = true;
    for (std::size_t i = 0; i < leaf.triangle_count; ++i) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            leaf.corners[i][corner] = read(corner_bytes, corners_at + corner * leaf.triangle_count + i, 1);
            is_sound &= leaf.corners[i][corner] < leaf.vertex_count;
        }
    }
    return is_sound;
}

bool TreeBytes::decode_strip_leaf(const DecodedNode& node, unsigned index, DecodedLeaf& leaf) const {
    namespace layout = format::strip_leaf;
    const std::size_t data = first_leaf_at(node);
    if (data > leaves.size()) return false;
    const std::uint32_t descriptor =
        read(leaves, node.leaf_block + layout::descriptors_at + layout::descriptor_bytes * std::size_t{index}, 4);
    leaf.first_triangle = read(leaves, node.leaf_block, 4) + (descriptor >> layout::first_shift);
    leaf.at = data + (descriptor & ((1u << layout::offset_bits) - 1));
    const unsigned entry_count = (descriptor >> layout::entries_shift & 63) + 3;
    if (entry_count > layout::max_small_entries || leaf.at > leaves.size()) return false;

    // The three rows of marks come before the references: with them it is known how many of those there are.
    const std::size_t rows = (3 * (std::size_t{entry_count} - 3) + 7) / 8;
    if (rows > leaves.size() - leaf.at) return false;
    std::array<bool, layout::max_small_entries> is_pivot{true};
    std::array<bool, layout::max_small_entries> is_triangle{true};
    std::array<bool, layout::max_small_entries> is_first_use{true, true, true};
    FieldReader counting(leaves.subspan(leaf.at, rows));
    for (unsigned i = 1; i + 2 < entry_count; ++i) is_pivot[i] = counting.next(1) != 0;
    for (unsigned i = 1; i + 2 < entry_count; ++i) is_triangle[i] = counting.next(1) != 0;
    for (unsigned i = 3; i < entry_count; ++i) is_first_use[i] = counting.next(1) != 0;
    leaf.vertex_count = static_cast<unsigned>(std::count(is_first_use.begin(), is_first_use.end(), true));

    const std::size_t mark_bytes = (layout::mark_bits(entry_count, leaf.vertex_count) + 7) / 8;
    std::array<unsigned, 3> widths{};
    leaf.bytes = mark_bytes;
    const DecodedBox& box = node.boxes[node.node_children + index];
    for (std::size_t axis = 0; axis < 3; ++axis) {
        widths[axis] = layout::coordinate_width(static_cast<std::uint32_t>(box.hi[axis] - box.lo[axis]), bits);
        leaf.bytes += (leaf.vertex_count * widths[axis] + 7) / 8;
    }
    if (leaf.bytes > leaves.size() - leaf.at) return false;

    FieldReader marks(leaves.subspan(leaf.at, mark_bytes));
    for (unsigned i = 0; i < 3 * (entry_count - 3); ++i) static_cast<void>(marks.next(1));
    std::array<std::uint32_t, layout::max_small_entries> entries{};
    std::uint32_t used = 0;
    for (unsigned i = 0; i < entry_count; ++i) {
        entries[i] = is_first_use[i] ? used++ : marks.next(layout::reference_width(leaf.vertex_count));
        if (entries[i] >= used) return false;
    }
    unsigned pivot = 0;
    bool keeps_order = false;
    leaf.triangle_count = 0;
    for (unsigned window = 0; window + 2 < entry_count; ++window) {
        if (is_pivot[window]) {
            pivot = window;
            keeps_order = !keeps_order;
        }
        if (!is_triangle[window]) continue;
        const std::uint32_t one = entries[window + 1];
        const std::uint32_t other = entries[window + 2];
        leaf.corners[leaf.triangle_count++] = {entries[pivot], keeps_order ? one : other, keeps_order ? other : one};
    }

    std::size_t at = leaf.at + mark_bytes;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t size = (leaf.vertex_count * widths[axis] + 7) / 8;
        FieldReader fields(leaves.subspan(at, size));
        for (unsigned i = 0; i < leaf.vertex_count; ++i) {
            leaf.vertices[i][axis] = box.lo[axis] + static_cast<std::int32_t>(fields.next(widths[axis]));
        }
        at += size;
    }
    return true;
}

}  // namespace espalier::baker
