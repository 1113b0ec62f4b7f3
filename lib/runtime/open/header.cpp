// The header and the places of the sections, which open() and open_unchecked() both check. O(1), without a float
// operation for the sake of cores that have none.
#include <runtime/blob/id_steps.hpp>
#include <runtime/blob/source_origin.hpp>
#include <runtime/open/checks.hpp>

namespace espalier {
namespace detail {
namespace {

/// The origin of a deformable blob is less than 2^127 steps from 0.
constexpr int max_origin_exponent = 126;

using format::feature::materials_16;
using format::feature::materials_8;

/// Tests the fields that only a deformable blob has. They are zero in every other one.
bool are_moving_fields_sound(const BlobData& blob) {
    using namespace format::header;
    const std::byte* const h = blob.bytes;
    if (!is_zero(h + reserved_at, bytes - reserved_at)) return false;
    if ((blob.features & read_features & format::feature::deformable) == 0)
        return is_zero(h + position_count_at, reserved_at - position_count_at);
    const std::uint32_t rest_cost = load_u32(h + rest_cost_at);
    if (load_u16(h + version_minor_at) < format::version_minor_of_deformable || !has_plain_leaves(blob.profile) ||
        (blob.features & format::feature::not_deformable) != 0 || blob.triangle_count == 0 || rest_cost < 0x00800000u ||
        rest_cost >= infinity_bits)
        return false;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t high = load_u32(h + pose_high_at + 4 * k);
        if (high > static_cast<std::uint32_t>(blob.extent[k]) || load_u32(h + pose_low_at + 4 * k) > high) return false;
        // The origin in steps is a float, and so refit() can count from it.
        if (exponent_of(blob.origin[k]) - blob.step_exponent > max_origin_exponent) return false;
    }
    return true;
}

bool is_minus_zero(float x) { return std::bit_cast<std::uint32_t>(x) == 0x80000000u; }

/// The bytes that are left, from whose front sections are taken. The only bounds check of sections.
struct Bytes {
    const std::byte* at;  ///< null when something was not there
    const std::byte* end;
    bool looks_at_padding;

    /// So many fields of so many bits, filled up to 4 bytes with zeros.
    ESPALIER_NOINLINE const std::byte* take(std::size_t fields, std::size_t field_bits) {
        const std::uint64_t bits = std::uint64_t{fields} * field_bits;
        const std::uint64_t words = (bits + 31) / 32;
        const std::byte* taken = at;
        // mutant(- -> +) compiler: pointers cannot be added
        if (taken == nullptr || words > static_cast<std::size_t>(end - taken) / 4) return at = nullptr;
        at += 4 * static_cast<std::size_t>(words);
        if (looks_at_padding && bits % 32 != 0 &&
            load_u32(taken + 4 * static_cast<std::size_t>(bits / 32)) >> (bits % 32) != 0)
            at = nullptr;
        return taken;
    }
};

}  // namespace

OpenStatus read_version_and_size(const std::byte* h, std::size_t size, BlobData& blob, const FileKind& kind) {
    using namespace format::header;
    if (size < format::header::bytes) return OpenStatus::too_short;
    blob.bytes = h;
    static_assert(magic_at == 0);
    if (load_u32(h) != kind.magic) return kind.refusal;
    if (load_u16(h + version_major_at) != kind.version_major || load_u16(h + version_minor_at) > kind.version_minor)
        return OpenStatus::unsupported_version;
    blob.size = load_u32(h + total_bytes_at);
    if (blob.size > size) return OpenStatus::too_short;
    if (blob.size < size) return OpenStatus::trailing_bytes;
    blob.checksum = load_u32(h + checksum_at);
    return OpenStatus::ok;
}

bool read_lattice(BlobData& blob) {
    using namespace format::header;
    const std::byte* const h = blob.bytes;
    blob.step_exponent = load_i16(h + step_exponent_at);
    // Finite, and the sign bit clear.
    if (blob.step_exponent < format::min_step_exponent || blob.step_exponent > format::max_step_exponent ||
        load_u32(h + max_error_at) >= infinity_bits)
        return false;
    blob.max_error = load_f32(h + max_error_at);
    for (std::size_t k = 0; k < 3; ++k) {
        blob.origin[k] = load_f32(h + origin_at + 4 * k);
        const std::uint32_t extent = load_u32(h + extent_at + 4 * k);
        if (!is_finite(blob.origin[k]) || is_minus_zero(blob.origin[k]) ||
            !is_multiple_of_power(blob.origin[k], blob.step_exponent) || extent >> blob.bits != 0)
            return false;
        blob.extent[k] = static_cast<std::int32_t>(extent);
    }
    return true;
}

OpenStatus read_header(BlobData& blob) {
    using namespace format::header;
    const std::byte* h = blob.bytes;
    blob.features = load_u32(h + features_at);
    if ((blob.features & ~read_features) != 0) return OpenStatus::unsupported_feature;
    const unsigned profile = load_u8(h + profile_at);
    blob.profile = static_cast<Profile>(profile);
    if (profile > static_cast<unsigned>(Profile::tiny)) return OpenStatus::unsupported_profile;
    // mutant(never) equivalent: the build for mutants reads all profiles
    if (!is_read(blob.profile)) return OpenStatus::unsupported_profile;  // not counted: builds of fewer profiles

    blob.bits = static_cast<std::uint8_t>(load_u8(h + bits_at));
    if (blob.bits < 1 || blob.bits > format::max_bits) return OpenStatus::bad_header;

    blob.triangle_count = load_u32(h + triangle_count_at);
    blob.vertex_count = load_u32(h + vertex_count_at);
    blob.node_count = load_u32(h + node_count_at);
    blob.leaf_bytes = load_u32(h + leaf_bytes_at);
    blob.depth = static_cast<std::uint8_t>(load_u8(h + depth_at));
    if (blob.triangle_count > format::max_triangles || blob.node_count > format::max_nodes ||
        blob.leaf_bytes % 4 != 0 || blob.depth > format::max_depth)
        return OpenStatus::bad_header;
    constexpr std::uint32_t of_triangles =
        format::feature::closed | format::feature::edge_flags | format::feature::bounds;
    if (blob.triangle_count == 0) {
        if ((blob.vertex_count | blob.node_count | blob.leaf_bytes | blob.depth | (blob.features & of_triangles)) != 0)
            return OpenStatus::bad_header;
    } else if (blob.vertex_count == 0 || blob.node_count == 0 || blob.leaf_bytes == 0 || blob.depth == 0) {
        return OpenStatus::bad_header;
    }

    constexpr std::uint32_t materials = materials_8 | materials_16;
    // Strips turn their triangles' corners, so that copies of one would not give the same weights.
    const std::uint32_t of_plain_leaves =
        has_plain_leaves(blob.profile) ? 0 : std::uint32_t{format::feature::split_references};
    if ((blob.features & materials) == materials || (blob.features & of_plain_leaves) != 0)
        return OpenStatus::bad_header;

    blob.source_count = load_u32(h + source_count_at);
    blob.source_triangles = load_u32(h + source_triangles_at);
    // With the two zero bytes behind them.
    const std::uint32_t id_kind_bits = load_u32(h + depth_at) >> 8;
    blob.id_kind_bits = static_cast<std::uint8_t>(id_kind_bits);
    const bool ids = (blob.features & read_features & format::feature::original_ids) != 0;
    if (ids ? id_kind_bits > format::ids::max_kind_bits ||
                  blob.source_triangles > ~std::uint32_t{0} / corner_factor(blob)
            : (id_kind_bits | blob.source_count | load_u32(h + id_step_bytes_at)) != 0)
        return OpenStatus::bad_header;
    if ((blob.features & read_features & format::feature::source_origin) != 0 &&
        load_u16(h + version_minor_at) < format::version_minor_of_source_origin)
        return OpenStatus::bad_header;
    if (has_runs(blob) && (!ids || load_u16(h + version_minor_at) < format::version_minor_of_id_runs))
        return OpenStatus::bad_header;

    if (!read_lattice(blob)) return OpenStatus::bad_header;
    if (!are_moving_fields_sound(blob)) return OpenStatus::bad_header;
    blob.derive();
    return locate_sections(blob, false);
}

OpenStatus locate_sections(BlobData& blob, bool looks_at_padding) {
    const std::byte* const end = blob.bytes + blob.size;
    Bytes rest = {blob.bytes + format::header::bytes, end, looks_at_padding};
    blob.nodes = rest.take(blob.node_count, 8 * format::node_bytes(blob.profile));
    blob.leaves = rest.take(blob.leaf_bytes, 8);
    rest.take(format::guard_bytes, 8);
    const std::uint32_t features = blob.features & read_features;  // so that no code is left for others
    if ((features & format::feature::original_ids) != 0) {
        blob.sources = rest.take(blob.source_count, 8 * format::source::bytes);
        blob.ids = rest.take(std::size_t{1} << blob.id_kind_bits, 8 * format::ids::kind_bytes);
        rest.take(load_u32(blob.bytes + format::header::id_step_bytes_at), 8);
        rest.take(format::ids::block_count(blob.triangle_count), 8 * format::ids::block_bytes(has_runs(blob)));
    }
    if ((features & (materials_8 | materials_16)) != 0)
        blob.materials = rest.take(blob.triangle_count, (features & materials_16) != 0 ? 16 : 8);
    if ((features & format::feature::split_references) != 0) {
        static_assert(format::copies::count_at == 0 && format::copies::blocks_at == 4);
        blob.copies = rest.take(1, 32);
        if (blob.copies != nullptr) blob.copy_count = load_u32(blob.copies);
        rest.take(format::copies::block_count(blob.triangle_count), 8 * format::copies::block_bytes);
        rest.take(blob.copy_count, 8 * format::copies::owner_bytes);
    }
    if ((features & format::feature::edge_flags) != 0) {
        static_assert(format::edge_flags::flat_limit_at == 0 && format::edge_flags::fields_at == 4);
        blob.edge_flags = rest.take(1, 32);
        rest.take(blob.triangle_count, format::edge_flags::triangle_bits);
    }
    if ((features & format::feature::bounds) != 0) blob.bounds = rest.take(format::bounds::bytes(blob.features), 8);
    if ((features & format::feature::deformable) != 0) {
        blob.corners = rest.take(blob.triangle_count, 8 * format::corners::triangle_bytes);
        rest.take(format::corners::guard_bytes, 8);
        rest.take(load_u32(blob.bytes + format::header::vertex_slots_at),
                  format::vertex_sources::number_bits(load_u32(blob.bytes + format::header::position_count_at)));
    }
    if ((features & format::feature::source_origin) != 0) {
        const std::byte* const origin = rest.take(format::source_origin::bytes, 8);
        if (origin != nullptr && !is_source_origin(origin)) return OpenStatus::bad_section;
    }
    return rest.at == end ? OpenStatus::ok : OpenStatus::bad_section;
}

void refuse(BlobData& blob, OpenStatus status) {
    blob = BlobData();
    blob.refusal = status;
}

void BlobData::derive() noexcept {
    // mutant(< -> <=) equivalent: writes a fourth number, which is 0 in the header and was 0 before
    for (int k = 0; k < 3; ++k) extent_steps[k] = whole_float(static_cast<std::uint32_t>(extent[k]));
    steps_per_unit = power_of_two(-step_exponent);
    // mutant(> -> >=) equivalent: both sides are equal then
    base_unit = power_of_two(bits > 16 ? bits - 16 : 0);
}

}  // namespace detail

// Without the proof. Nothing here reads behind the header, except the number of duplicate references.
Blob open_unchecked(std::span<const std::byte> bytes) noexcept {
    Blob blob;
    OpenStatus status = detail::read_version_and_size(bytes.data(), bytes.size(), blob.data_);
    if (status == OpenStatus::ok) status = detail::read_header(blob.data_);
    if (status != OpenStatus::ok) detail::refuse(blob.data_, status);
    return blob;
}

}  // namespace espalier
