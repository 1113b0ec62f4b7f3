// The proof that every query on a blob is safe. One pass over the bytes in the order in which they are stored; the only
// place that checks anything but the header, which header.cpp does.

#include <runtime/blob/checksum.hpp>
#include <runtime/blob/duplicate_references.hpp>
#include <runtime/blob/id_steps.hpp>
#include <runtime/open/checks.hpp>
#include <runtime/traversal/find.hpp>

namespace espalier {
namespace detail {
namespace {

/// The blocks of leaves, in the order of the nodes.
template <class Node>
struct LeafBlocks {
    OpenProgress seen;

    [[nodiscard]] std::uint32_t next() const { return seen.leaf_bytes / 4; }
    OpenStatus take(const Node& node) { return take_leaves(node, seen) ? OpenStatus::ok : OpenStatus::bad_leaf; }
};

template <class Node>
OpenStatus check_tree_of(const BlobData& blob) {
    LeafBlocks<Node> blocks = {{blob}};
    const OpenStatus status = check_tree<Node>(blob, blocks);
    if (status != OpenStatus::ok) return status;
    const bool are_all_seen =
        blocks.seen.triangles == blob.triangle_count && blocks.seen.leaf_bytes == blob.leaf_bytes &&
        (!is_deformable(blob) || blocks.seen.vertex_slots == load_u32(blob.bytes + format::header::vertex_slots_at));
    return are_all_seen ? OpenStatus::ok : OpenStatus::bad_leaf;
}

/// Whether the bits of a block of so many triangles end within `bytes`, its runs begin where the table states, each of
/// them filled up with zero bits to a whole byte, and every number is one that the sources can have. `walk` is then
/// behind them.
bool is_block_sound(IdWalk& walk, const std::byte* block, std::uint32_t triangles, std::uint32_t bytes) {
    using namespace format::ids;
    const std::uint32_t limit = number_limit(walk.blob);
    const auto end_run = [&walk] {
        const unsigned end = walk.fields.bit;
        walk.fields.bit = (end + 7) / 8 * 8;
        return is_padded_with_zeros(walk.fields.bytes, end);
    };
    if (static_cast<std::uint32_t>(std::bit_width(walk.mask)) > 8 * bytes) return false;
    walk.begin();
    const bool runs = has_runs(walk.blob);
    const std::uint32_t of_run = run_triangles(runs);
    std::uint32_t begins = 0;
    for (std::uint32_t at = 0;;) {
        if (walk.newest >= limit) return false;
        if (++at == triangles) break;
        if (at % of_run == 0) {
            if (!end_run()) return false;
            begins |= walk.fields.bit / 8 << run_begin_bits * (at / of_run - 1);
            walk.begin_run();
        }
        if (walk.find_kind() > 8 * bytes - walk.fields.bit) return false;
        walk.take_step();
    }
    return end_run() && (!runs || load_u32(block + runs_at) == begins);
}

bool is_kind_sound(const BlobData& blob, const std::byte* kind) {
    using namespace format::ids;
    const std::uint32_t places = load_u8(kind + from_at) | load_u8(kind + replaced_at);
    static_assert(std::has_single_bit(recent_numbers));
    return load_u8(kind + width_at) <= static_cast<std::uint32_t>(std::bit_width(number_mask(blob))) &&
           load_u8(kind + prefix_at) <= blob.id_kind_bits && places < recent_numbers;
}

/// The bits of each block begin where those of the block before it end.
bool are_numbers_sound(const BlobData& blob) {
    using namespace format::ids;
    constexpr std::uint32_t max_bytes_of_a_block = block_triangles * (max_kind_bits + 32) / 8 + 4;
    const std::uint32_t step_bytes = load_u32(blob.bytes + format::header::id_step_bytes_at);
    for (std::uint32_t kind = 0; kind >> blob.id_kind_bits == 0; ++kind)
        if (!is_kind_sound(blob, id_kind(blob, kind))) return false;
    std::uint32_t begin = 0;
    for (std::uint32_t first = 0; first < blob.triangle_count; first += block_triangles) {
        const std::byte* const block = id_block(blob, first / block_triangles);
        if (load_u32(block + begin_at) != begin) return false;
        const std::uint32_t left = blob.triangle_count - first;
        const std::uint32_t bytes_left = step_bytes - begin;
        IdWalk walk(blob, begin);
        // mutant(< -> <= 1, < -> <= 2) equivalent: both sides are equal then
        if (!is_block_sound(walk, block, left < block_triangles ? left : block_triangles,
                            bytes_left < max_bytes_of_a_block ? bytes_left : max_bytes_of_a_block))
            return false;
        begin += walk.fields.bit / 8;
    }
    return begin == step_bytes;
}

/// The source table and the numbers that count through it.
bool are_ids_sound(const BlobData& blob) {
    std::uint32_t previous = 0;
    for (std::uint32_t i = 0; i < blob.source_count; ++i) {
        const std::uint32_t first = load_u32(blob.sources + std::size_t{i} * format::source::bytes);
        if (first < previous || (i == 0 && first != 0)) return false;
        previous = first;
    }
    if (previous > blob.source_triangles || (blob.source_count == 0 && blob.triangle_count != 0)) return false;
    return are_numbers_sound(blob);
}

/// The map of copies: ranks add up, and every copy is of a triangle with a lower storage index that is none.
bool are_copies_sound(const BlobData& blob) {
    using namespace format::copies;
    if (blob.copy_count == 0) return false;
    const std::uint32_t indices = block_count(blob.triangle_count) * block_indices;  // at most 2^31
    const std::byte* const owners = copy_owners(blob);
    std::uint32_t seen = 0;
    for (std::uint32_t index = 0; index < indices; ++index) {
        if (index % block_indices == 0 && load_u32(copy_block(blob.copies, index)) != seen) return false;
        if (!is_duplicate_reference(blob.copies, index)) continue;
        if (index >= blob.triangle_count || seen == blob.copy_count) return false;
        const std::uint32_t owner = load_u32(owners + owner_bytes * std::size_t{seen});
        // mutant(>= -> >) equivalent: the index itself is a copy, which the second condition refuses
        if (owner >= index || is_duplicate_reference(blob.copies, owner)) return false;
        ++seen;
    }
    return seen == blob.copy_count;
}

/// Any flags are safe: they are hints.
bool are_edge_flags_sound(const BlobData& blob) {
    using namespace format::edge_flags;
    static_assert(flat_limit_at == 0);
    return load_u32(blob.edge_flags) <= max_flat_limit;
}

/// Returns whether arithmetic on the bounds stays within its widths. Bounds that hold nothing are safe.
bool are_bounds_sound(const BlobData& blob) {
    using namespace format::bounds;
    const auto is_within = [](std::int32_t value, std::uint32_t limit) {
        return static_cast<std::uint32_t>(value) + limit <= 2 * limit;
    };
    const std::byte* at = blob.bounds;
    if ((blob.features & format::feature::oriented_box) != 0) {
        std::int32_t any = 0;
        for (; at != blob.bounds + lo_at; at += 2) {
            if (!is_within(load_i16(at), max_quaternion)) return false;
            any |= load_i16(at);
        }
        if (any == 0) return false;
    }
    for (; at != blob.bounds + bytes(blob.features); at += 4)
        if (!is_within(load_i32(at), max_length)) return false;
    return true;
}

/// Every vertex has a position, and the guard behind the corners is zero. The pass over the leaves has read the
/// corners.
bool are_vertex_sources_sound(const BlobData& blob) {
    const std::byte* at = vertex_sources_of(blob);
    if (!is_zero(at - format::corners::guard_bytes, format::corners::guard_bytes)) return false;
    const std::uint32_t count = load_u32(blob.bytes + format::header::position_count_at);
    const bool is_short = format::vertex_sources::number_bits(count) == 16;
    for (std::uint32_t left = load_u32(blob.bytes + format::header::vertex_slots_at); left != 0; --left) {
        if ((is_short ? load_u16(at) : load_u32(at)) >= count) return false;
        at += is_short ? 2 : 4;
    }
    return true;
}

/// Each in its turn, as far as they are there.
ESPALIER_NOINLINE bool are_optional_sections_sound(const BlobData& blob) {
    using namespace format::feature;
    // mutant(without 2, without 8, without 14, without 19) equivalent: the build for mutants reads all sections
    return (!reads(original_ids) || blob.ids == nullptr || are_ids_sound(blob)) &&
           (!reads(split_references) || blob.copies == nullptr || are_copies_sound(blob)) &&
           (!reads(edge_flags) || blob.edge_flags == nullptr || are_edge_flags_sound(blob)) &&
           (!reads(bounds) || blob.bounds == nullptr || are_bounds_sound(blob)) &&
           (!is_deformable(blob) || are_vertex_sources_sound(blob));
}

OpenStatus check_sections(BlobData& blob) {
    if (!is_zero(blob.leaves + blob.leaf_bytes, format::guard_bytes)) return OpenStatus::bad_section;
    if (blob.triangle_count != 0)
        if (const OpenStatus status =
                scalar::with_leaves_of(blob, [&]<class Leaf>() { return check_tree_of<typename Leaf::Node>(blob); });
            status != OpenStatus::ok)
            return status;
    return are_optional_sections_sound(blob) ? locate_sections(blob, true) : OpenStatus::bad_section;
}

}  // namespace
}  // namespace detail

Blob open(std::span<const std::byte> bytes) noexcept {
    Blob blob;  // built in the caller's: a second one would be a fifth of the stack that this takes
    OpenStatus status = detail::read_version_and_size(bytes.data(), bytes.size(), blob.data_);
    if (status == OpenStatus::ok && blob.data_.checksum != detail::checksum_of_blob(bytes))
        status = OpenStatus::bad_checksum;
    if (status == OpenStatus::ok) status = detail::read_header(blob.data_);
    if (status == OpenStatus::ok) status = detail::check_sections(blob.data_);
    if (status != OpenStatus::ok) detail::refuse(blob.data_, status);
    return blob;
}

}  // namespace espalier
