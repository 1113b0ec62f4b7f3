// The proof that every query on a blob is safe. One pass over the bytes in the order in which they are stored; the only
// place that checks anything, through the one bounds check of `Bytes`.
#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/blob.hpp>
#include <runtime/bytes.hpp>
#include <runtime/checksum.hpp>
#include <runtime/copies.hpp>
#include <runtime/float_bits.hpp>
#include <runtime/id_field.hpp>
#include <runtime/leaf_kinds.hpp>
#include <runtime/open_checks.hpp>

namespace espalier {
namespace detail {
namespace {

using format::feature::materials_16;
using format::feature::materials_8;

/// Takes sections off the front of what is left. The only bounds check.
struct Bytes {
    const std::byte* at;
    std::size_t left;

    [[gnu::noinline]] const std::byte* take(std::uint64_t count) {
        if (count > left) return nullptr;
        const std::byte* taken = at;
        at += static_cast<std::size_t>(count);
        left -= static_cast<std::size_t>(count);
        return taken;
    }
};

/// Takes so many bits, filled up with zeros to 4 bytes; null when they are not there or not zero.
[[gnu::noinline]] const std::byte* take_bits(Bytes& rest, std::uint64_t bit_count) {
    const std::uint64_t used = (bit_count + 7) / 8;
    const std::uint64_t padded = (used + 3) & ~std::uint64_t{3};
    const std::byte* taken = rest.take(padded);
    if (taken == nullptr || !is_padded_with_zeros(taken, bit_count)) return nullptr;
    return is_zero(taken + used, static_cast<std::size_t>(padded - used)) ? taken : nullptr;
}

Status read_header(std::span<const std::byte> bytes, BlobData& blob) {
    using namespace format::header;
    if (bytes.size() < format::header::bytes) return Status::too_short;
    const std::byte* h = bytes.data();
    static_assert(magic_at == 0);
    if (load_u32(h) != format::magic) return Status::not_a_blob;
    if (load_u16(h + version_major_at) != format::version_major ||
        load_u16(h + version_minor_at) > format::version_minor)
        return Status::unsupported_version;
    blob.size = load_u32(h + total_bytes_at);
    if (blob.size > bytes.size()) return Status::too_short;
    if (blob.size < bytes.size()) return Status::trailing_bytes;
    blob.checksum = load_u32(h + checksum_at);
    if (blob.checksum != checksum_of_blob(bytes)) return Status::bad_checksum;
    blob.features = load_u32(h + features_at);
    if ((blob.features & ~format::feature::known) != 0) return Status::unsupported_feature;
    const unsigned profile = load_u8(h + profile_at);
    blob.profile = static_cast<format::Profile>(profile);
    if (profile > static_cast<unsigned>(format::Profile::small)) return Status::unsupported_profile;
    if (!is_read(blob.profile)) return Status::unsupported_profile;  // GCOVR_EXCL_BR_LINE: builds of fewer profiles

    blob.bytes = h;
    blob.triangle_count = load_u32(h + triangle_count_at);
    blob.vertex_count = load_u32(h + vertex_count_at);
    blob.node_count = load_u32(h + node_count_at);
    blob.leaf_bytes = load_u32(h + leaf_bytes_at);
    blob.source_count = load_u32(h + source_count_at);
    blob.source_triangles = load_u32(h + source_triangles_at);
    blob.max_error = load_f32(h + max_error_at);
    blob.step_exponent = load_i16(h + step_exponent_at);
    const unsigned bits = load_u8(h + bits_at);
    const unsigned depth = load_u8(h + depth_at);
    const unsigned id_bits = load_u8(h + id_bits_at);

    const bool empty = blob.triangle_count == 0;
    const bool ids = (blob.features & format::feature::original_ids) != 0;
    bool good = bits >= 1 && bits <= unsigned{format::max_bits};
    good &= blob.step_exponent >= format::min_step_exponent && blob.step_exponent <= format::max_step_exponent;
    good &= blob.triangle_count <= format::max_triangles && blob.node_count <= format::max_nodes;
    good &= empty == (blob.node_count == 0) && empty == (blob.leaf_bytes == 0) && empty == (blob.vertex_count == 0);
    good &= empty == (depth == 0) && depth <= format::max_depth && blob.leaf_bytes % 4 == 0;
    good &= is_finite(blob.max_error) && !is_negative(blob.max_error);
    good &= (blob.features & (materials_8 | materials_16)) != (materials_8 | materials_16);
    constexpr std::uint32_t of_triangles =
        format::feature::closed | format::feature::edge_flags | format::feature::bounds;
    good &= !(empty && (blob.features & of_triangles) != 0);
    // Strips turn their triangles' corners, so that copies of one would not give the same weights.
    good &= has_indexed_leaves(blob.profile) || (blob.features & format::feature::split_references) == 0;
    good &= ids ? id_bits <= 32 : id_bits == 0 && blob.source_count == 0;
    good &= is_zero(h + id_bits_at + 1, 2) && is_zero(h + reserved_at, format::header::bytes - reserved_at);
    if (!good) return Status::bad_header;
    for (std::size_t k = 0; k < 3; ++k) {
        blob.origin[k] = load_f32(h + origin_at + 4 * k);
        const std::uint32_t extent = load_u32(h + extent_at + 4 * k);
        if (!is_finite(blob.origin[k]) || flush_subnormal(blob.origin[k]) != blob.origin[k] || extent >> bits != 0)
            return Status::bad_header;
        blob.extent[k] = static_cast<std::int32_t>(extent);
    }
    blob.bits = static_cast<std::uint8_t>(bits);
    blob.depth = static_cast<std::uint8_t>(depth);
    blob.id_bits = static_cast<std::uint8_t>(id_bits);
    blob.derive();
    return Status::ok;
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
Status check_original_ids(BlobData& blob, Bytes& rest) {
    blob.sources = rest.take(std::uint64_t{blob.source_count} * format::source::bytes);
    if (blob.sources == nullptr) return Status::bad_section;
    std::uint32_t previous = 0;
    for (std::uint32_t i = 0; i < blob.source_count; ++i) {
        const std::uint32_t first = load_u32(blob.sources + std::size_t{i} * format::source::bytes);
        if (i == 0 ? first != 0 : first < previous) return Status::bad_section;
        previous = first;
    }
    if (previous > blob.source_triangles || (blob.source_count == 0 && blob.triangle_count != 0))
        return Status::bad_section;
    const unsigned corner_bits = format::first_corner_bits(blob.profile);
    blob.ids = take_bits(rest, std::uint64_t{blob.triangle_count} * (corner_bits + blob.id_bits));
    if (blob.ids == nullptr) return Status::bad_section;
    if (corner_bits != 0)
        for (std::uint32_t i = 0; i < blob.triangle_count; ++i)
            if ((id_field(blob, i) & 3u) == 3) return Status::bad_section;
    return Status::ok;
}

/// The map of copies: ranks add up, and every copy is of a triangle with a lower storage index that is none. Not
/// inlined: its variables must not lie on the stack under check_tree.
[[gnu::noinline]] Status check_copies(BlobData& blob, Bytes& rest) {
    using namespace format::copies;
    const std::byte* count = rest.take(blocks_at);
    if (count == nullptr) return Status::bad_section;
    const std::uint32_t copy_count = load_u32(count);
    const std::byte* blocks = rest.take(blocks_bytes(blob.triangle_count));
    const std::byte* owners = blocks == nullptr ? nullptr : rest.take(std::uint64_t{copy_count} * owner_bytes);
    if (owners == nullptr || copy_count == 0) return Status::bad_section;
    blob.copies = count;
    std::uint32_t seen = 0;
    const std::uint64_t bits = blocks_bytes(blob.triangle_count) / block_bytes * block_indices;
    for (std::uint64_t i = 0; i < bits; ++i) {
        const auto index = static_cast<std::uint32_t>(i);
        if (index % block_indices == 0 && load_u32(copy_block(blob, index)) != seen) return Status::bad_section;
        if (!is_copy(blob, index)) continue;
        if (index >= blob.triangle_count || seen == copy_count) return Status::bad_section;
        const std::uint32_t owner = load_u32(owners + owner_bytes * std::size_t{seen});
        if (owner >= index || is_copy(blob, owner)) return Status::bad_section;
        ++seen;
    }
    blob.copy_count = copy_count;
    return seen == copy_count ? Status::ok : Status::bad_section;
}

/// Any flags are safe: they are hints.
Status check_edge_flags(BlobData& blob, Bytes& rest) {
    using namespace format::edge_flags;
    static_assert(flat_limit_at == 0);
    blob.edge_flags = take_bits(rest, 8 * fields_at + std::uint64_t{blob.triangle_count} * triangle_bits);
    const bool good = blob.edge_flags != nullptr && load_u32(blob.edge_flags) <= max_flat_limit;
    return good ? Status::ok : Status::bad_section;
}

/// That the arithmetic of whoever reads the bounds stays within its widths. Bounds that hold nothing are safe.
Status check_bounds(BlobData& blob, Bytes& rest) {
    using namespace format::bounds;
    const std::byte* at = blob.bounds = rest.take(format::bounds::bytes(blob.features));
    if (at == nullptr) return Status::bad_section;
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

Status check_sections(std::span<const std::byte> bytes, BlobData& blob) {
    Bytes rest = {bytes.data(), bytes.size()};
    rest.take(format::header::bytes);
    blob.nodes = rest.take(std::uint64_t{blob.node_count} * format::node::bytes);
    blob.leaves = blob.nodes == nullptr ? nullptr : rest.take(blob.leaf_bytes);
    const std::byte* guard = blob.leaves == nullptr ? nullptr : rest.take(format::guard_bytes);
    if (guard == nullptr || !is_zero(guard, format::guard_bytes)) return Status::bad_section;
    if (blob.triangle_count != 0)
        if (const Status status = check_tree(blob); status != Status::ok) return status;
    if ((blob.features & format::feature::original_ids) != 0)
        if (const Status status = check_original_ids(blob, rest); status != Status::ok) return status;
    if ((blob.features & (materials_8 | materials_16)) != 0) {
        blob.materials =
            take_bits(rest, std::uint64_t{blob.triangle_count} * ((blob.features & materials_16) != 0 ? 16u : 8u));
        if (blob.materials == nullptr) return Status::bad_section;
    }
    if ((blob.features & format::feature::split_references) != 0)
        if (const Status status = check_copies(blob, rest); status != Status::ok) return status;
    if ((blob.features & format::feature::edge_flags) != 0)
        if (const Status status = check_edge_flags(blob, rest); status != Status::ok) return status;
    if ((blob.features & format::feature::bounds) != 0)
        if (const Status status = check_bounds(blob, rest); status != Status::ok) return status;
    return rest.left == 0 ? Status::ok : Status::bad_section;
}

/// Apart, so that small cores have the code once.
[[gnu::noinline]] void make_empty(Blob& blob) { blob = Blob(); }

}  // namespace

void BlobData::derive() noexcept {
    for (int k = 0; k < 3; ++k) extent_steps[k] = static_cast<float>(extent[k]);
    steps_per_unit = power_of_two(-step_exponent);
    base_unit = power_of_two(bits > 16 ? bits - 16 : 0);
}

}  // namespace detail

Status open(std::span<const std::byte> bytes, Blob& blob) noexcept {
    // Straight into the caller's blob: a copy of its own would be a fifth of the stack that this takes.
    detail::make_empty(blob);
    Status status = detail::read_header(bytes, blob.data_);
    if (status == Status::ok) status = detail::check_sections(bytes, blob.data_);
    if (status != Status::ok) detail::make_empty(blob);
    return status;
}

}  // namespace espalier
