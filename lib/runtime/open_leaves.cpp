// The part of `open` that proves the leaves, stream by stream: no byte is looked at before it is known to be inside the
// section, but for the few that the guard behind the section is there for.
#include <bit>

#include <runtime/leaf_kinds.hpp>
#include <runtime/open_checks.hpp>

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

/// Tests whether all coordinates are inside the asset and differ along an axis as the leaf's size states.
bool are_sound_coordinates(const PlainLeaf& leaf, const BlobData& blob) {
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
        if (most > blob.extent[k]) return false;
        differences |= static_cast<std::uint32_t>(most - least);
    }
    // The least size that is true, as far as a descriptor can hold it.
    const unsigned least_size = format::plain_leaf::least_size(blob.bits);
    const auto size = static_cast<unsigned>(std::bit_width(differences));
    // mutant(> -> >=) equivalent: both sides are equal then
    return leaf.size_bits == (size > least_size ? size : least_size);
}

/// Takes the vertices of a strip, which must be inside the asset.
bool take_vertices(const StripLeaf& leaf, OpenProgress& seen) {
    for (int k = 0; k < 3; ++k)
        if (!take_fields(seen, leaf.vertex_count, leaf.width[k], seen.blob.extent[k] - leaf.anchor(k))) return false;
    return true;
}

bool take_strip_leaves(const PackedNode& node, const std::byte* descriptors, OpenProgress& seen) {
    using namespace format::strip_leaf;
    const unsigned most_entries =
        seen.blob.profile == format::Profile::balanced ? max_balanced_entries : max_small_entries;
    const std::uint32_t first = seen.triangles;
    const std::uint32_t data = seen.leaf_bytes;
    for (unsigned number = 0; number < node.leaf_children(); ++number) {
        const std::uint32_t descriptor = load_u32(descriptors + descriptor_bytes * std::size_t{number});
        if ((descriptor & ((1u << offset_bits) - 1u)) != seen.leaf_bytes - data) return false;
        if ((descriptor >> entries_shift & 63u) + 3 > most_entries) return false;
        if (descriptor >> first_shift != seen.triangles - first) return false;
        const auto leaf = leaf_at<StripLeaf>(seen.blob, node, number);
        const std::uint32_t begin = seen.leaf_bytes;
        if (take_stream(seen, mark_bits(leaf.entry_count(), leaf.vertex_count)) == nullptr ||
            !take_vertices(leaf, seen) || seen.leaf_bytes == begin)  // three entries on one point have no data
            return false;
        unsigned used = 0;
        for (unsigned entry = 0; entry < leaf.entry_count(); ++entry) {
            if ((leaf.first_uses >> entry & 1) != 0) ++used;
            else if (leaf.entry(entry) >= used) return false;
        }
        seen.triangles += leaf.triangle_count();
    }
    return true;
}

}  // namespace

bool take_leaves(PackedNode node, OpenProgress& seen) {
    using namespace format::strip_leaf;
    if (node.leaf_children() == 0) return true;
    const std::size_t head = descriptors_at + descriptor_bytes * std::size_t{node.leaf_children()};
    const std::byte* const block = take_stream(seen, 8 * static_cast<unsigned>(head));
    if (block == nullptr || load_u32(block) != seen.triangles) return false;
    // The number of triangles here already, block by block: a sum at the end could have gone around in 32 bits.
    return take_strip_leaves(node, block + descriptors_at, seen) && seen.triangles <= seen.blob.triangle_count &&
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
        const auto leaf = leaf_at<PlainLeaf>(seen.blob, node, number);
        const std::size_t bytes = data_bytes(leaf.vertex_count, leaf.slot_count, seen.blob.bits);
        if (take_stream(seen, 8 * static_cast<unsigned>(bytes)) == nullptr || leaf.first() != seen.triangles ||
            !are_sound_coordinates(leaf, seen.blob) || !take_padding(seen, 4))
            return false;
        for (unsigned corner = 0; corner < 3u * leaf.slot_count; ++corner)
            if (load_u8(leaf.corner_row + corner) >= leaf.vertex_count) return false;
        seen.triangles += leaf.slot_count;
        if (seen.triangles > seen.blob.triangle_count) return false;
    }
    return true;
}

}  // namespace espalier::detail
