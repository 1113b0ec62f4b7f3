// The proof that every query on a blob is safe. One pass over the bytes in the order in which they are stored; the only
// place that checks anything but the header, which open_header.cpp does.
#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/blob.hpp>
#include <runtime/bytes.hpp>
#include <runtime/checksum.hpp>
#include <runtime/copies.hpp>
#include <runtime/leaf_kinds.hpp>
#include <runtime/open_checks.hpp>
#include <runtime/open_header.hpp>

namespace espalier {
namespace detail {
namespace {

/// Whether a stream of so many bits is filled up with zeros to 4 bytes.
[[gnu::noinline]] bool is_padded_to_words(const std::byte* stream, std::uint64_t bit_count) {
    const std::uint64_t used = (bit_count + 7) / 8;
    return is_padded_with_zeros(stream + static_cast<std::size_t>(bit_count / 8), bit_count % 8) &&
           is_zero(stream + static_cast<std::size_t>(used), static_cast<std::size_t>(-used & 3));
}

Status check_node(const BlobData& blob, const Node& node, OpenProgress& seen) {
    const unsigned nodes = node.node_children();
    const unsigned children = nodes + node.leaf_children();
    if (children == 0 || children > format::max_children) return Status::bad_node;
    if (load_u16(node.bytes + format::node::shifts_at) >> 15 != 0) return Status::bad_node;
    if (node.first_child() != (nodes == 0 ? 0 : seen.nodes)) return Status::bad_node;
    if (nodes > blob.node_count - seen.nodes) return Status::bad_node;
    seen.nodes += nodes;
    for (int axis = 0; axis < 3; ++axis) {
        if (node.shift(axis) > format::node::max_shift) return Status::bad_node;
        for (unsigned child = 0; child < format::max_children; ++child) {
            const std::uint32_t low = load_u8(node.low_planes(axis) + child);
            const std::uint32_t high = load_u8(node.high_planes(axis) + child);
            if (child < children ? low > high : (low | high) != 0) return Status::bad_node;
        }
    }
    return check_leaves(blob, node, seen);
}

/// Every node exactly once, children after their parents, in depth-first order with a stack as deep as the format
/// allows.
Status check_tree(const BlobData& blob) {
    struct Siblings {
        std::uint32_t next;
        std::uint32_t end;
    };
    Siblings stack[format::max_depth + 1];
    OpenProgress seen;
    unsigned depth = 1;
    stack[1 - 1] = {0, 1};
    while (depth != 0) {
        Siblings& siblings = stack[depth - 1];
        if (siblings.next == siblings.end) {
            --depth;
            continue;
        }
        if (depth > blob.depth) return Status::bad_node;
        seen.depth = depth > seen.depth ? depth : seen.depth;
        const Node node = node_at(blob, siblings.next++);
        if (const Status status = check_node(blob, node, seen); status != Status::ok) return status;
        stack[depth++] = {node.first_child(), node.first_child() + node.node_children()};
    }
    if (seen.nodes != blob.node_count || seen.depth != blob.depth) return Status::bad_node;
    if (seen.triangles != blob.triangle_count || std::uint64_t{4} * seen.leaf_words != blob.leaf_bytes)
        return Status::bad_leaf;
    return Status::ok;
}

/// The source table and the ids that count through it.
Status check_original_ids(const BlobData& blob) {
    std::uint32_t previous = 0;
    for (std::uint32_t i = 0; i < blob.source_count; ++i) {
        const std::uint32_t first = load_u32(blob.sources + std::size_t{i} * format::source::bytes);
        if (i == 0 ? first != 0 : first < previous) return Status::bad_section;
        previous = first;
    }
    if (previous > blob.source_triangles || (blob.source_count == 0 && blob.triangle_count != 0))
        return Status::bad_section;
    const unsigned corner_bits = reads_strip_leaves ? format::first_corner_bits(blob.profile) : 0;
    const unsigned field_bits = corner_bits + blob.id_bits;
    const std::uint64_t bits = std::uint64_t{blob.triangle_count} * field_bits;
    if (!is_padded_to_words(blob.ids, bits)) return Status::bad_section;
    // Not both bits of a first corner.
    const auto bit = [&](std::uint64_t at) {
        return load_u8(blob.ids + static_cast<std::size_t>(at / 8)) >> (at % 8) & 1u;
    };
    if (corner_bits != 0)
        for (std::uint64_t at = 0; at < bits; at += field_bits)
            if ((bit(at) & bit(at + 1)) != 0) return Status::bad_section;
    return Status::ok;
}

/// The map of copies: ranks add up, and every copy is of a triangle with a lower storage index that is none. Not
/// inlined: its variables must not lie on the stack under check_tree.
[[gnu::noinline]] Status check_copies(const BlobData& blob) {
    using namespace format::copies;
    if (blob.copy_count == 0) return Status::bad_section;
    const std::byte* const owners =
        blob.copies + blocks_at + static_cast<std::size_t>(blocks_bytes(blob.triangle_count));
    std::uint32_t seen = 0;
    const std::uint64_t bits = blocks_bytes(blob.triangle_count) / block_bytes * block_indices;
    for (std::uint64_t i = 0; i < bits; ++i) {
        const auto index = static_cast<std::uint32_t>(i);
        if (index % block_indices == 0 && load_u32(copy_block(blob, index)) != seen) return Status::bad_section;
        if (!is_copy(blob, index)) continue;
        if (index >= blob.triangle_count || seen == blob.copy_count) return Status::bad_section;
        const std::uint32_t owner = load_u32(owners + owner_bytes * std::size_t{seen});
        if (owner >= index || is_copy(blob, owner)) return Status::bad_section;
        ++seen;
    }
    return seen == blob.copy_count ? Status::ok : Status::bad_section;
}

/// Any flags are safe: they are hints.
Status check_edge_flags(const BlobData& blob) {
    using namespace format::edge_flags;
    static_assert(flat_limit_at == 0);
    const bool good =
        is_padded_to_words(blob.edge_flags, 8 * fields_at + std::uint64_t{blob.triangle_count} * triangle_bits) &&
        load_u32(blob.edge_flags) <= max_flat_limit;
    return good ? Status::ok : Status::bad_section;
}

/// That the arithmetic of whoever reads the bounds stays within its widths. Bounds that hold nothing are safe.
Status check_bounds(const BlobData& blob) {
    using namespace format::bounds;
    const std::byte* at = blob.bounds;
    const std::byte* const end = at + format::bounds::bytes(blob.features);
    bool good = true;
    const auto check = [&](std::int32_t value, std::int32_t limit) { good &= value <= limit && value >= -limit; };
    if ((blob.features & format::feature::oriented_box) != 0) {
        std::int32_t any = 0;
        for (; at != blob.bounds + lo_at; at += 2) {
            check(load_i16(at), max_quaternion);
            any |= load_i16(at);
        }
        good &= any != 0;
    }
    for (; at != end; at += 4) check(load_i32(at), max_length);
    return good ? Status::ok : Status::bad_section;
}

/// Each in its turn, as far as they are there.
Status check_sections(const BlobData& blob) {
    if (!is_zero(blob.leaves + blob.leaf_bytes, format::guard_bytes)) return Status::bad_section;
    if (blob.triangle_count != 0)
        if (const Status status = check_tree(blob); status != Status::ok) return status;
    if (blob.ids != nullptr)
        if (const Status status = check_original_ids(blob); status != Status::ok) return status;
    const unsigned material_bits = (blob.features & format::feature::materials_16) != 0 ? 16 : 8;
    if (blob.materials != nullptr &&
        !is_padded_to_words(blob.materials, std::uint64_t{blob.triangle_count} * material_bits))
        return Status::bad_section;
    if (blob.copies != nullptr)
        if (const Status status = check_copies(blob); status != Status::ok) return status;
    if (blob.edge_flags != nullptr)
        if (const Status status = check_edge_flags(blob); status != Status::ok) return status;
    return blob.bounds == nullptr ? Status::ok : check_bounds(blob);
}

}  // namespace
}  // namespace detail

Status open(std::span<const std::byte> bytes, Blob& blob) noexcept {
    // Straight into the caller's blob: a copy of its own would be a fifth of the stack that this takes.
    detail::make_empty(blob);
    Status status = detail::read_version_and_size(bytes, blob.data_);
    if (status == Status::ok && blob.data_.checksum != detail::checksum_of_blob(bytes)) status = Status::bad_checksum;
    if (status == Status::ok) status = detail::read_fields(blob.data_);
    if (status == Status::ok) status = detail::locate_sections(blob.data_);
    if (status == Status::ok) status = detail::check_sections(blob.data_);
    if (status != Status::ok) detail::make_empty(blob);
    return status;
}

}  // namespace espalier
