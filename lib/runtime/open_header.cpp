// The header and where it says that the sections lie: what `open` and `open_trusted_image` have in common. O(1). It
// needs no float operation, for the sake of cores that have none.
#include <runtime/bytes.hpp>
#include <runtime/float_bits.hpp>
#include <runtime/leaf_kinds.hpp>
#include <runtime/open_checks.hpp>
#include <runtime/open_header.hpp>

namespace espalier::detail {
namespace {

using format::feature::materials_16;
using format::feature::materials_8;

/// Takes sections off the front of what is left. The only bounds check.
struct Bytes {
    const std::byte* at;
    std::size_t left;
    bool fits = true;

    [[gnu::noinline]] const std::byte* take(std::uint64_t count) {
        fits &= count <= left;
        if (!fits) return nullptr;
        const std::byte* taken = at;
        at += static_cast<std::size_t>(count);
        left -= static_cast<std::size_t>(count);
        return taken;
    }

    /// So many bits, filled up to 4 bytes.
    const std::byte* take_bits(std::uint64_t bit_count) { return take((bit_count + 31) / 32 * 4); }
};

}  // namespace

Status read_version_and_size(std::span<const std::byte> bytes, BlobData& blob) {
    using namespace format::header;
    if (bytes.size() < format::header::bytes) return Status::too_short;
    const std::byte* h = blob.bytes = bytes.data();
    static_assert(magic_at == 0);
    if (load_u32(h) != format::magic) return Status::not_a_blob;
    if (load_u16(h + version_major_at) != format::version_major ||
        load_u16(h + version_minor_at) > format::version_minor)
        return Status::unsupported_version;
    blob.size = load_u32(h + total_bytes_at);
    if (blob.size > bytes.size()) return Status::too_short;
    if (blob.size < bytes.size()) return Status::trailing_bytes;
    blob.checksum = load_u32(h + checksum_at);
    return Status::ok;
}

Status read_fields(BlobData& blob) {
    using namespace format::header;
    const std::byte* h = blob.bytes;
    blob.features = load_u32(h + features_at);
    if ((blob.features & ~format::feature::known) != 0) return Status::unsupported_feature;
    const unsigned profile = load_u8(h + profile_at);
    blob.profile = static_cast<format::Profile>(profile);
    if (profile > static_cast<unsigned>(format::Profile::small)) return Status::unsupported_profile;
    if (!is_read(blob.profile)) return Status::unsupported_profile;  // GCOVR_EXCL_BR_LINE: builds of fewer profiles

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
    const bool any = (blob.node_count | blob.leaf_bytes | blob.vertex_count | depth) != 0;
    const bool all = blob.node_count != 0 && blob.leaf_bytes != 0 && blob.vertex_count != 0 && depth != 0;
    const bool ids = (blob.features & format::feature::original_ids) != 0;
    constexpr std::uint32_t materials = materials_8 | materials_16;
    constexpr std::uint32_t of_triangles =
        format::feature::closed | format::feature::edge_flags | format::feature::bounds;
    // Strips turn their triangles' corners, so that copies of one would not give the same weights.
    const std::uint32_t of_indexed_leaves =
        has_indexed_leaves(blob.profile) ? 0 : std::uint32_t{format::feature::split_references};
    if (bits < 1 || bits > unsigned{format::max_bits} || blob.step_exponent < format::min_step_exponent ||
        blob.step_exponent > format::max_step_exponent || blob.triangle_count > format::max_triangles ||
        blob.node_count > format::max_nodes || (empty ? any : !all) || depth > format::max_depth ||
        blob.leaf_bytes % 4 != 0 || !is_finite(blob.max_error) || is_negative(blob.max_error) ||
        (blob.features & materials) == materials || (empty && (blob.features & of_triangles) != 0) ||
        (blob.features & of_indexed_leaves) != 0 || (ids ? id_bits > 32 : (id_bits | blob.source_count) != 0) ||
        !is_zero(h + id_bits_at + 1, 2) || !is_zero(h + reserved_at, format::header::bytes - reserved_at))
        return Status::bad_header;
    for (std::size_t k = 0; k < 3; ++k) {
        blob.origin[k] = load_f32(h + origin_at + 4 * k);
        const std::uint32_t extent = load_u32(h + extent_at + 4 * k);
        if (!is_finite(blob.origin[k]) || is_subnormal(blob.origin[k]) || extent >> bits != 0)
            return Status::bad_header;
        blob.extent[k] = static_cast<std::int32_t>(extent);
    }
    blob.bits = static_cast<std::uint8_t>(bits);
    blob.depth = static_cast<std::uint8_t>(depth);
    blob.id_bits = static_cast<std::uint8_t>(id_bits);
    blob.derive();
    return Status::ok;
}

Status locate_sections(BlobData& blob) {
    Bytes rest = {blob.bytes, blob.size};
    rest.take(format::header::bytes);
    blob.nodes = rest.take(std::uint64_t{blob.node_count} * format::node::bytes);
    blob.leaves = rest.take(blob.leaf_bytes);
    rest.take(format::guard_bytes);
    const std::uint64_t triangles = blob.triangle_count;
    if ((blob.features & format::feature::original_ids) != 0) {
        blob.sources = rest.take(std::uint64_t{blob.source_count} * format::source::bytes);
        blob.ids = rest.take_bits(triangles * (format::first_corner_bits(blob.profile) + unsigned{blob.id_bits}));
    }
    if ((blob.features & (materials_8 | materials_16)) != 0)
        blob.materials = rest.take_bits(triangles * ((blob.features & materials_16) != 0 ? 16u : 8u));
    if ((blob.features & format::feature::split_references) != 0) {
        static_assert(format::copies::count_at == 0);
        blob.copies = rest.take(format::copies::blocks_at);
        if (blob.copies == nullptr) return Status::bad_section;
        blob.copy_count = load_u32(blob.copies);
        rest.take(format::copies::blocks_bytes(blob.triangle_count));
        rest.take(std::uint64_t{blob.copy_count} * format::copies::owner_bytes);
    }
    if ((blob.features & format::feature::edge_flags) != 0)
        blob.edge_flags =
            rest.take_bits(8 * format::edge_flags::fields_at + triangles * format::edge_flags::triangle_bits);
    if ((blob.features & format::feature::bounds) != 0) blob.bounds = rest.take(format::bounds::bytes(blob.features));
    return rest.fits && rest.left == 0 ? Status::ok : Status::bad_section;
}

void make_empty(Blob& blob) { blob = Blob(); }

void BlobData::derive() noexcept {
    for (int k = 0; k < 3; ++k) extent_steps[k] = whole_float(static_cast<std::uint32_t>(extent[k]));
    steps_per_unit = power_of_two(-step_exponent);
    base_unit = power_of_two(bits > 16 ? bits - 16 : 0);
}

}  // namespace espalier::detail
