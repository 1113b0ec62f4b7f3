// The part of `open` that proves the leaves. `left` is always what remains of the leaf section: no byte is looked at
// before it is known to be inside, but for the few that the guard behind the section is there for.
#include <runtime/leaf_kinds.hpp>
#include <runtime/open_checks.hpp>

namespace espalier::detail {
namespace {

// Inlined: it lies on the stack at its deepest, which is promised to be small.
template <class Leaf>
[[gnu::always_inline]] inline bool are_vertices_inside(const BlobData& blob, const Leaf& leaf) {
    for (int k = 0; k < 3; ++k) {
        if (!is_padded_with_zeros(leaf.coordinates[k], unsigned{leaf.vertex_count} * leaf.width[k])) return false;
        const std::int32_t anchor = leaf.anchor(k);
        for (unsigned i = 0; i < leaf.vertex_count; ++i)
            if (anchor + static_cast<std::int32_t>(load_field(leaf.coordinates[k], leaf.width[k], i)) > blob.extent[k])
                return false;
    }
    return true;
}

/// Bytes of a leaf's data, or 0.
std::size_t checked_size(const BlobData& blob, const IndexedLeaf& leaf, std::size_t left) {
    const unsigned field = 3u * leaf.corner_width;
    const std::size_t size = static_cast<std::size_t>(leaf.triangles - leaf.coordinates[0]) +
                             format::indexed_leaf::stream_bytes(leaf.slot_count, field);
    if (size > left) return 0;
    for (int k = 0; k < 3; ++k)
        if (leaf.width[k] > blob.bits) return 0;
    if (!is_padded_with_zeros(leaf.triangles, leaf.slot_count * field)) return 0;
    if (!are_vertices_inside(blob, leaf)) return 0;
    for (unsigned i = 0; i < leaf.slot_count; ++i) {
        std::uint32_t corners = load_field(leaf.triangles, field, i);
        for (int corner = 0; corner < 3; ++corner, corners >>= leaf.corner_width)
            if ((corners & ((1u << leaf.corner_width) - 1u)) >= leaf.vertex_count) return 0;
    }
    return size;
}

std::size_t checked_size(const BlobData& blob, const StripLeaf& leaf, std::size_t left) {
    const unsigned mark_bits = format::strip_leaf::mark_bits(leaf.entry_count(), leaf.vertex_count);
    std::size_t size = (mark_bits + 7) / 8;
    for (int k = 0; k < 3; ++k) size += (std::size_t{leaf.vertex_count} * leaf.width[k] + 7) / 8;
    if (size > left) return 0;
    if (!is_padded_with_zeros(leaf.marks, mark_bits) || !are_vertices_inside(blob, leaf)) return 0;
    unsigned used = 0;
    for (unsigned entry = 0; entry < leaf.entry_count(); ++entry) {
        if ((leaf.first_uses >> entry & 1) != 0) ++used;
        else if (leaf.entry(entry) >= used) return 0;
    }
    return size;
}

[[maybe_unused]] Status check_indexed_leaves(const BlobData& blob, const Node& node, std::size_t left,
                                             std::uint32_t& used, OpenProgress& seen) {
    using namespace format::indexed_leaf;
    const unsigned count = node.leaf_children();
    const std::byte* block = node.leaf_block(blob);
    for (unsigned number = 0; number < count; ++number) {
        const std::uint32_t descriptor = load_u32(block + descriptors_at + descriptor_bytes * std::size_t{number});
        if (used % 2 != 0) {  // then a byte is left: all that is left when a block begins is words
            if (!is_zero(block + descriptors_at + descriptor_bytes * std::size_t{count} + used, 1))
                return Status::bad_leaf;
            ++used;
        }
        if ((descriptor & ((1u << offset_bits) - 1u)) != used / 2) return Status::bad_leaf;
        const IndexedLeaf leaf = indexed_leaf(blob, node, number);
        const std::size_t size = checked_size(blob, leaf, left - used);
        if (size == 0) return Status::bad_leaf;
        seen.triangles += leaf.slot_count;
        used += static_cast<std::uint32_t>(size);
    }
    return Status::ok;
}

[[maybe_unused]] Status check_strip_leaves(const BlobData& blob, const Node& node, std::size_t left,
                                           std::uint32_t& used, OpenProgress& seen) {
    using namespace format::strip_leaf;
    const unsigned most_entries = blob.profile == format::Profile::balanced ? max_balanced_entries : max_small_entries;
    const std::byte* block = node.leaf_block(blob);
    const std::uint32_t first = seen.triangles;
    for (unsigned number = 0; number < node.leaf_children(); ++number) {
        const std::uint32_t descriptor = load_u32(block + descriptors_at + descriptor_bytes * std::size_t{number});
        if ((descriptor & ((1u << offset_bits) - 1u)) != used) return Status::bad_leaf;
        if ((descriptor >> entries_shift & 63u) + 3 > most_entries) return Status::bad_leaf;
        if (descriptor >> first_shift != seen.triangles - first) return Status::bad_leaf;
        const StripLeaf leaf = strip_leaf(blob, node, number);
        const std::size_t size = checked_size(blob, leaf, left - used);
        if (size == 0) return Status::bad_leaf;
        seen.triangles += leaf.triangle_count();
        used += static_cast<std::uint32_t>(size);
    }
    return Status::ok;
}

}  // namespace

Status check_leaves(const BlobData& blob, const Node& node, OpenProgress& seen) {
    using namespace format::indexed_leaf;  // blocks of both kinds begin alike
    static_assert(descriptors_at == format::strip_leaf::descriptors_at &&
                  descriptor_bytes == format::strip_leaf::descriptor_bytes);
    const std::uint32_t block_words = load_u32(node.bytes + format::node::leaf_block_at);
    if (node.leaf_children() == 0) return block_words == 0 ? Status::ok : Status::bad_node;
    if (block_words != seen.leaf_words) return Status::bad_node;
    std::size_t left = blob.leaf_bytes - std::size_t{4} * seen.leaf_words;
    const std::size_t head = descriptors_at + descriptor_bytes * std::size_t{node.leaf_children()};
    if (head > left) return Status::bad_leaf;
    left -= head;
    const std::byte* block = node.leaf_block(blob);
    if (load_u32(block) != seen.triangles) return Status::bad_leaf;
    std::uint32_t used = 0;
    Status status = Status::unsupported_profile;
    if (has_indexed_leaves(blob.profile)) {
        if constexpr (reads_indexed_leaves) status = check_indexed_leaves(blob, node, left, used, seen);
    } else {
        if constexpr (reads_strip_leaves) status = check_strip_leaves(blob, node, left, used, seen);
    }
    if (status != Status::ok) return status;
    // Head and section are whole words, so that the padding is in the section too.
    static_assert(descriptors_at % 4 == 0 && descriptor_bytes % 4 == 0);
    const std::size_t padding = (4 - (head + used) % 4) % 4;
    if (!is_zero(block + head + used, padding)) return Status::bad_leaf;
    seen.leaf_words += static_cast<std::uint32_t>((head + used + padding) / 4);
    return Status::ok;
}

}  // namespace espalier::detail
