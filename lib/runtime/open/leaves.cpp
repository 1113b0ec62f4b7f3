// The part of `open` that proves the leaves, stream by stream: no byte is looked at before it is known to be inside the
// section, but for the few that the guard behind the section is there for.
#include <runtime/blob/plain_leaf.hpp>
#include <runtime/blob/strip_leaf.hpp>
#include <runtime/open/checks.hpp>

namespace espalier::detail {
namespace {

/// Takes a stream of so many bits off the front of what is left, or returns null: when it is not all there, or is not
/// filled up with zeros.
const std::byte* take_stream(OpenProgress& seen, unsigned bits) {
    const std::byte* const stream = seen.blob.leaves + seen.leaf_bytes;
    const unsigned bytes = (bits + 7) / 8;
    if (bytes > seen.blob.leaf_bytes - seen.leaf_bytes || !is_padded_with_zeros(stream, bits)) return nullptr;
    seen.leaf_bytes += bytes;
    return stream;
}

/// Takes a stream of fields, none of which must be more than `most`.
ESPALIER_SHARED_CODE inline bool take_fields(OpenProgress& seen, unsigned count, unsigned width, std::int32_t most) {
    const std::byte* const stream = take_stream(seen, count * width);
    if (stream == nullptr) return false;
    for (unsigned i = 0; i < count; ++i)
        if (static_cast<std::int32_t>(load_field(stream, width, i)) > most) return false;
    return true;
}

/// Takes zeros up to a multiple of so many bytes of the section. They are inside: the section is whole words.
ESPALIER_SHARED_CODE inline bool take_padding(OpenProgress& seen, std::uint32_t unit) {
    const std::uint32_t padding = -seen.leaf_bytes & (unit - 1);
    const std::byte* const at = seen.blob.leaves + seen.leaf_bytes;
    seen.leaf_bytes += padding;
    return is_zero(at, padding);
}

/// Tests whether all coordinates are inside the asset's box and differ along an axis as the leaf's size states.
bool are_sound_coordinates(const PlainLeaf& leaf, const OpenProgress& seen) {
    const std::byte* word = leaf.words();
    const std::byte* high_byte = leaf.high_bytes();
    const bool has_high_bytes = leaf.has_high_bytes();
    std::uint32_t differences = 0;  // as many bits as the largest
    for (int k = 0; k < 3; ++k) {
        // mutant(<< -> one more, - -> +, - -> right side dropped) equivalent: the first vertex replaces any such number
        std::int32_t least = (1 << format::max_bits) - 1, most = 0;
        for (unsigned left = leaf.vertex_count; left != 0; --left, word += 2) {
            auto coordinate = static_cast<std::int32_t>(load_u16(word));
            if (has_high_bytes) coordinate |= static_cast<std::int32_t>(load_u8(high_byte++) << 16);
            // mutant(< -> <=) equivalent: both sides are equal then
            least = coordinate < least ? coordinate : least;
            // mutant(> -> >=) equivalent: both sides are equal then
            most = coordinate > most ? coordinate : most;
        }
        if (least < seen.bounds.low[k] || most > seen.bounds.high[k]) return false;
        differences |= static_cast<std::uint32_t>(most - least);
    }
    // The least size that is true, as far as a descriptor can hold it.
    const unsigned least_size = format::plain_leaf::least_size(seen.blob.bits);
    const auto size = static_cast<unsigned>(std::bit_width(differences));
    // mutant(> -> >=) equivalent: both sides are equal then
    return leaf.size_bits == (size > least_size ? size : least_size);
}

/// Whether entries name vertices that were used before.
inline bool are_sound_entries(const StripLeaf& leaf) {
    unsigned used = 0;
    for (unsigned entry = 0; entry < leaf.entry_count(); ++entry) {
        if ((leaf.first_uses >> entry & 1) != 0) ++used;
        else if (leaf.entry(entry) >= used) return false;
    }
    return true;
}

bool take_stored_strips(const PackedNode& node, const std::byte* descriptors, OpenProgress& seen) {
    using namespace format::strip_leaf;
    const unsigned most_entries = seen.blob.profile == Profile::balanced ? max_balanced_entries : max_small_entries;
    const std::uint32_t first = seen.triangles;
    const std::uint32_t data = seen.leaf_bytes;
    for (unsigned number = 0; number < node.leaf_children(); ++number) {
        const std::uint32_t descriptor = load_u32(descriptors + descriptor_bytes * std::size_t{number});
        if ((descriptor & ((1u << offset_bits) - 1u)) != seen.leaf_bytes - data) return false;
        if ((descriptor >> entries_shift & 63u) + 3 > most_entries) return false;
        if (descriptor >> first_shift != seen.triangles - first) return false;
        const auto leaf = leaf_at<StripLeaf>(seen.blob, node, number);
        const std::uint32_t begin = seen.leaf_bytes;
        if (take_stream(seen, mark_bits(leaf.entry_count(), leaf.vertex_count)) == nullptr) return false;
        for (int k = 0; k < 3; ++k)  // its vertices must be inside the asset
            if (!take_fields(seen, leaf.vertex_count, leaf.width[k], seen.blob.extent[k] - leaf.anchor(k)))
                return false;
        // Three entries on one point have no data.
        if (seen.leaf_bytes == begin || !are_sound_entries(leaf)) return false;
        seen.triangles += leaf.triangle_count();
    }
    return true;
}

#if ESPALIER_PREDICTED_STRIPS

/// Whether joints are where paths can end and begin: in order, and with a triangle between.
bool are_sound_joints(const std::byte* data, unsigned marked, unsigned joints) {
    using namespace format::predicted_strip;
    unsigned least = 1;
    for (unsigned i = 0; i < joints; ++i) {
        const unsigned window = load_few_bits(data, marks_at + 2 * marked + place_bits * i, place_bits);
        if (window < least || window + 2 > marked) return false;
        least = window + 3;
    }
    return true;
}

/// Whether widths are of a small and a large residual, and the leaf's numbers end where its bytes do. All its bits up
/// to the numbers are inside the section.
bool are_sound_widths(const StripLeaf& leaf, unsigned bits, unsigned bytes) {
    const unsigned predicted = (unsigned{leaf.predicted.numbers_at} - leaf.predicted.choices_at) / 3;
    const ResidualWidths widths(leaf);
    unsigned end = leaf.predicted.numbers_at;
    for (unsigned k = 0; k < 3; ++k) {
        const unsigned large = widths.large[k], small = widths.small[k];
        if (large > format::predicted_strip::max_width(bits) || small > large) return false;
        unsigned larger = 0;
        for (unsigned i = 0; i < predicted; ++i)
            larger += load_few_bits(leaf.marks, leaf.predicted.choices_at + 3 * i + k, 1);
        end += larger * large + (predicted - larger) * small + (leaf.vertex_count - predicted) * leaf.width[k];
    }
    return (end + 7) / 8 == bytes && is_padded_with_zeros(leaf.marks, end);
}

/// Whether all vertices of a predicted strip are inside the asset, and as far from its anchor as its box reaches.
bool are_sound_vertices(StripLeaf& leaf, const BlobData& blob) {
    PredictedVertices vertices;
    if (!decode_predicted_vertices(leaf, vertices)) return false;
    use_vertices(vertices, leaf);
    for (int k = 0; k < 3; ++k)
        for (unsigned i = 0; i < leaf.vertex_count; ++i)
            if (leaf.anchor(k) + leaf.offset(k, i) > blob.extent[k]) return false;
    return true;
}

bool take_predicted_strips(const PackedNode& node, const std::byte* descriptors, OpenProgress& seen) {
    using namespace format::predicted_strip;
    for (unsigned number = 0; number < node.leaf_children(); ++number) {
        const std::uint32_t descriptor = load_u16(descriptors + descriptor_bytes * std::size_t{number});
        const unsigned bytes = descriptor & ((1u << entries_shift) - 1u);
        const unsigned marked = descriptor >> entries_shift;
        if (marked + 3 > max_entries || bytes > seen.blob.leaf_bytes - seen.leaf_bytes) return false;
        // With the guard, the section has what the marks take at most, and with it all that follows is inside.
        StripLeaf leaf;
        decode_predicted_marks(seen.blob, node, number, leaf);
        // mutant(without 2, without 3) equivalent: are_sound_widths refuses it too; the choices of widths that are read
        // before that end at most 69 bytes from where the data begins, five of which are not in the guard
        if (leaf.vertex_count > max_vertices || leaf.predicted.numbers_at > 8 * bytes ||
            !are_sound_joints(leaf.marks, marked, joint_count(leaf.marks)) ||
            !are_sound_widths(leaf, seen.blob.bits, bytes) || !are_sound_entries(leaf) ||
            !are_sound_vertices(leaf, seen.blob))
            return false;
        seen.leaf_bytes += bytes;
        seen.triangles += leaf.triangle_count();
    }
    return true;
}

#endif

bool take_strips(const PackedNode& node, const std::byte* descriptors, OpenProgress& seen) {
#if ESPALIER_PREDICTED_STRIPS
    if (has_predicted_leaves(seen.blob.profile)) return take_predicted_strips(node, descriptors, seen);
#endif
    return take_stored_strips(node, descriptors, seen);
}

}  // namespace

bool take_leaves(PackedNode node, OpenProgress& seen) {
    using namespace format::strip_leaf;
    if (node.leaf_children() == 0) return true;
    const bool are_predicted = has_predicted_leaves(seen.blob.profile);
    const std::size_t each = are_predicted ? format::predicted_strip::descriptor_bytes : descriptor_bytes;
    const std::size_t head = descriptors_at + each * node.leaf_children();
    const std::byte* const block = take_stream(seen, 8 * static_cast<unsigned>(head));
    if (block == nullptr || load_u32(block) != seen.triangles) return false;
    // The number of triangles here already, block by block: a sum at the end could have gone around in 32 bits.
    return take_strips(node, block + descriptors_at, seen) && seen.triangles <= seen.blob.triangle_count &&
           take_padding(seen, 4);
}

bool take_leaves(PlainNode node, OpenProgress& seen) {
    using namespace format::plain_leaf;
    const std::uint32_t block = seen.leaf_bytes;
    const unsigned leaves = node.leaf_children();
    for (unsigned number = 0; number < PlainNode::max_children; ++number) {
        const std::uint32_t descriptor = node.leaf_descriptor(number) & ((1u << 8 * descriptor_bytes) - 1u);
        if (number >= leaves) {
            if (descriptor != 0) return false;
            continue;
        }
        if (4 * (descriptor & ((1u << offset_bits) - 1u)) != seen.leaf_bytes - block) return false;
        // Here the leaf begins, or the guard. A decoded leaf has its corners by the number of its first triangle.
        static_assert(first_at == 0);
        if (load_u32(seen.blob.leaves + seen.leaf_bytes) != seen.triangles) return false;
        const auto leaf = leaf_at<PlainLeaf>(seen.blob, node, number);
        const unsigned own_corners = is_deformable(seen.blob) ? 0 : leaf.slot_count;
        const std::size_t bytes = data_bytes(leaf.vertex_count, own_corners, seen.blob.bits);
        if (take_stream(seen, 8 * static_cast<unsigned>(bytes)) == nullptr || !are_sound_coordinates(leaf, seen) ||
            !take_padding(seen, 4))
            return false;
        if (leaf.slot_count > seen.blob.triangle_count - seen.triangles) return false;
        for (unsigned corner = 0; corner < 3u * leaf.slot_count; ++corner)
            if (load_u8(leaf.corner_row + corner) >= leaf.vertex_count) return false;
        seen.vertex_slots += leaf.vertex_count;
        seen.triangles += leaf.slot_count;
    }
    return true;
}

}  // namespace espalier::detail
