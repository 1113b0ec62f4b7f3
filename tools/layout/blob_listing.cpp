#include "listing.hpp"

#include <algorithm>
#include <bit>
#include <functional>
#include <iterator>
#include <string_view>
#include <vector>

#include <espalier/format.hpp>

#include <import/base/numbers.hpp>
#include <runtime/blob/id_steps.hpp>

namespace espalier::tools {

namespace {

using FieldKind = HeaderField::Kind;

constexpr HeaderField blob_header_fields[] = {
    {format::header::magic_at, 4, "magic", FieldKind::text},
    {format::header::version_major_at, 2, "format version, major", FieldKind::integer},
    {format::header::version_minor_at, 2, "format version, minor", FieldKind::integer},
    {format::header::total_bytes_at, 4, "bytes in all", FieldKind::integer},
    {format::header::checksum_at, 4, "checksum", FieldKind::hexadecimal},
    {format::header::features_at, 4, "features", FieldKind::hexadecimal},
    {format::header::profile_at, 1, "profile", FieldKind::integer},
    {format::header::bits_at, 1, "lattice bits", FieldKind::integer},
    {format::header::step_exponent_at, 2, "step exponent", FieldKind::signed_integer},
    {format::header::triangle_count_at, 4, "triangles", FieldKind::integer},
    {format::header::vertex_count_at, 4, "vertices", FieldKind::integer},
    {format::header::node_count_at, 4, "nodes", FieldKind::integer},
    {format::header::leaf_bytes_at, 4, "bytes of leaves", FieldKind::integer},
    {format::header::origin_at, 12, "origin", FieldKind::real},
    {format::header::extent_at, 12, "extent in steps", FieldKind::integer},
    {format::header::max_error_at, 4, "max error", FieldKind::real},
    {format::header::depth_at, 1, "depth", FieldKind::integer},
    {format::header::id_kind_bits_at, 1, "bits of the kind of an id's step", FieldKind::integer},
    {format::header::id_kind_bits_at + 1, 2, "reserved", FieldKind::zero},
    {format::header::source_count_at, 4, "source meshes", FieldKind::integer},
    {format::header::source_triangles_at, 4, "source triangles", FieldKind::integer},
    {format::header::id_step_bytes_at, 4, "bytes of the steps of ids", FieldKind::integer},
};
constexpr HeaderField deformable_fields[] = {
    {format::header::position_count_at, 4, "positions", FieldKind::integer},
    {format::header::vertex_slots_at, 4, "vertices of all leaves together", FieldKind::integer},
    {format::header::rest_cost_at, 4, "cost of the tree at rest", FieldKind::real},
    {format::header::pose_low_at, 12, "low corner of the pose in steps", FieldKind::integer},
    {format::header::pose_high_at, 12, "high corner of the pose in steps", FieldKind::integer},
};

/// Of any bytes, also those of a blob that was refused.
std::vector<HeaderField> fields_of(Bytes bytes) {
    using namespace format::header;
    std::vector<HeaderField> fields(std::begin(blob_header_fields), std::end(blob_header_fields));
    if (bytes.size() >= features_at + 4 && (read_u32(bytes, features_at) & format::feature::deformable) != 0)
        fields.insert(fields.end(), std::begin(deformable_fields), std::end(deformable_fields));
    const std::size_t at = fields.back().at + fields.back().bytes;
    fields.push_back({at, format::header::bytes - at, "reserved", FieldKind::zero});
    return fields;
}

void list_leaves(Bytes bytes, const Blob& blob, const Section& leaves, ByteListing& listing) {
    struct Block {
        std::size_t at;
        std::size_t node;
    };
    std::vector<Block> blocks;
    for (std::size_t node = 0; node < detail::data_of(blob).node_count; ++node) {
        const NodeFields fields = read_node(bytes, blob, node);
        if (fields.leaves > 0) blocks.push_back({leaves.at + std::size_t{4} * fields.leaf_block, node});
    }
    std::sort(blocks.begin(), blocks.end(), [](const Block& a, const Block& b) { return a.at < b.at; });
    for (const Block& block : blocks) {
        if (listing.full()) return;
        listing.field_up_to(block.at, "padding");
        list_leaf_block(bytes, blob, block.node, listing);
    }
    listing.field_up_to(leaves.at + leaves.bytes, "padding");
}

/// Fields of one width, eight to a line: they end on a byte. `value` is the text of the one that begins at a bit.
void list_values(const Section& section, std::uint32_t count, unsigned width, const char* name,
                 const std::function<std::string(std::size_t)>& value, ByteListing& listing) {
    for (std::uint32_t first = 0; first < count && !listing.full(); first += 8) {
        const std::uint32_t here = std::min(count - first, 8u);
        std::string values;
        for (std::uint32_t i = 0; i < here; ++i) values += text(' ', value(listing.at() * 8 + i * width));
        listing.field((std::size_t{here} * width + 7) / 8, text(name, " of triangles from ", first, ':', values));
    }
    listing.field_up_to(section.at + section.bytes, "padding");
}

void list_ids(Bytes bytes, const detail::BlobData& data, ByteListing& listing) {
    using namespace format::ids;
    for (unsigned kind = 0; kind >> data.id_kind_bits == 0 && !listing.full(); ++kind) {
        const std::size_t at = listing.at();
        listing.field(kind_bytes, text("kind ", kind, ": prefix ", read_u8(bytes, at + prefix_at), " bits, field ",
                                       read_u8(bytes, at + width_at), " bits, offset ", read_u32(bytes, at + offset_at),
                                       " from recent number ", read_u8(bytes, at + from_at), ", replaces ",
                                       read_u8(bytes, at + replaced_at)));
    }
    const std::size_t steps_begin = listing.at();
    const auto end_of_block = [&](std::uint32_t block) {
        const bool is_last = block + 1 == block_count(data.triangle_count);
        const auto next = static_cast<std::size_t>(detail::id_block(data, block + 1) - data.bytes);
        return steps_begin + read_u32(bytes, is_last ? format::header::id_step_bytes_at : next);
    };
    const std::uint32_t factor = corner_factor(data.profile);
    for (std::uint32_t first = 0; first < data.triangle_count && !listing.full(); first += block_triangles) {
        std::string values;
        for (std::uint32_t i = first; i < std::min(first + block_triangles, data.triangle_count); ++i) {
            const std::uint32_t number = detail::number_of(data, i);
            values += text(' ', number / factor, factor == 1 ? "" : text('.', number % factor));
        }
        listing.field_up_to(end_of_block(first / block_triangles),
                            text(factor == 1 ? "ids" : "ids.first corners", " of triangles from ", first, ':', values));
    }
    listing.field_up_to(static_cast<std::size_t>(detail::id_block(data, 0) - data.bytes), "padding");
    for (std::uint32_t first = 0; first < data.triangle_count && !listing.full(); first += block_triangles) {
        const std::size_t at = listing.at();
        std::string runs;
        const std::uint32_t of_run = run_triangles(detail::has_runs(data));
        for (std::uint32_t run = 1; run * of_run < std::min(block_triangles, data.triangle_count - first); ++run)
            runs += text(run == 1 ? ", runs " : " ", detail::run_begin(data.bytes + at, run), " bytes on");
        listing.field(block_bytes(detail::has_runs(data)),
                      text("block of triangles from ", first, ": at byte ", read_u32(bytes, at + begin_at), runs));
    }
}

void list_materials(Bytes bytes, const Section& section, const detail::BlobData& data, ByteListing& listing) {
    const unsigned width = (data.features & format::feature::materials_16) != 0 ? 16 : 8;
    const auto value = [&](std::size_t bit) { return text(read_bits(bytes, bit, width)); };
    list_values(section, data.triangle_count, width, "materials", value, listing);
}

void list_sources(Bytes bytes, std::uint32_t count, ByteListing& listing) {
    for (std::uint32_t i = 0; i < count && !listing.full(); ++i) {
        const std::size_t at = listing.at();
        listing.field(format::source::bytes,
                      text("source ", i, ": ids from ", read_u32(bytes, at + format::source::first_at), ", file ",
                           read_u32(bytes, at + format::source::file_at), ", mesh ",
                           read_u32(bytes, at + format::source::mesh_at)));
    }
}

void list_copies(Bytes bytes, const Section& section, const detail::BlobData& data, ByteListing& listing) {
    namespace field = format::copies;
    listing.field(field::blocks_at, text("copies ", data.copy_count));
    const std::size_t owners_at =
        section.at + field::blocks_at + static_cast<std::size_t>(field::blocks_bytes(data.triangle_count));
    for (std::uint32_t first = 0; listing.at() < owners_at && !listing.full(); first += field::block_indices) {
        const std::uint32_t before = read_u32(bytes, listing.at());
        listing.field(field::block_bytes, text("copies among triangles from ", first, ", ", before, " before them"));
    }
    for (std::uint32_t i = 0; i < data.copy_count && !listing.full(); ++i) {
        listing.field(field::owner_bytes, text("copy ", i, " is of triangle ", read_u32(bytes, listing.at())));
    }
}

void list_edge_flags(Bytes bytes, const Section& section, const detail::BlobData& data, ByteListing& listing) {
    listing.field(format::edge_flags::fields_at,
                  text("squared sine of what is flat: ", read_u32(bytes, listing.at()), " / 2^24"));
    const auto value = [&](std::size_t bit) {
        std::string kinds;
        for (unsigned edge = 0; edge < 3; ++edge)
            kinds +=
                "-^vo"[read_bits(bytes, bit + edge * format::edge_flags::edge_bits, format::edge_flags::edge_bits)];
        return kinds;
    };
    list_values(section, data.triangle_count, format::edge_flags::triangle_bits,
                "edges (- flat, ^ convex, v concave, o open)", value, listing);
}

std::string signed_numbers(Bytes bytes, std::size_t at, unsigned count) {
    std::string result;
    for (unsigned i = 0; i < count; ++i) result += text(' ', static_cast<std::int32_t>(read_u32(bytes, at + 4 * i)));
    return result;
}

void list_oriented_box(Bytes bytes, ByteListing& listing) {
    std::string quaternion;
    for (unsigned i = 0; i < 4; ++i)
        quaternion += text(' ', static_cast<int>(static_cast<std::int16_t>(read_u16(bytes, listing.at() + 2 * i))));
    listing.field(8, "quaternion w x y z" + quaternion);
    listing.field(12, "low, in steps / 16" + signed_numbers(bytes, listing.at(), 3));
    listing.field(12, "high, in steps / 16" + signed_numbers(bytes, listing.at(), 3));
}

void list_sphere(Bytes bytes, ByteListing& listing) {
    listing.field(12, "center, in steps / 16" + signed_numbers(bytes, listing.at(), 3));
    listing.field(4, "radius, in steps / 16" + signed_numbers(bytes, listing.at(), 1));
}

void list_k_dop(Bytes bytes, ByteListing& listing) {
    for (const auto& d : format::bounds::k_dop_direction) {
        listing.field(8, text("along ", int{d[0]}, ' ', int{d[1]}, ' ', int{d[2]}, ": low and high",
                              signed_numbers(bytes, listing.at(), 2)));
    }
}

void list_source_origin(Bytes bytes, ByteListing& listing) {
    for (const char axis : {'x', 'y', 'z'})
        listing.field(8, text(axis, " of the source where the blob has 0: ", read_f64(bytes, listing.at())));
}

void list_section(Bytes bytes, const Blob& blob, const Section& section, ByteListing& listing) {
    const std::string_view name = section.name;
    const detail::BlobData& data = detail::data_of(blob);
    if (name == "header") return list_blob_header(bytes, listing);
    listing.heading(section.name);
    if (name == "nodes") {
        list_nodes(bytes, blob, listing);
    } else if (name == "leaves") {
        list_leaves(bytes, blob, section, listing);
    } else if (name == "guard") {
        listing.field(section.bytes, "zeros, so that wide loads stay inside");
    } else if (name == "sources") {
        list_sources(bytes, data.source_count, listing);
    } else if (name == "original_ids") {
        list_ids(bytes, data, listing);
    } else if (name == "materials") {
        list_materials(bytes, section, data, listing);
    } else if (name == "copies") {
        list_copies(bytes, section, data, listing);
    } else if (name == "edge_flags") {
        list_edge_flags(bytes, section, data, listing);
    } else if (name == "oriented_box") {
        list_oriented_box(bytes, listing);
    } else if (name == "sphere") {
        list_sphere(bytes, listing);
    } else if (name == "k_dop") {
        list_k_dop(bytes, listing);
    } else if (name == "corners") {
        list_corners(bytes, blob, section, listing);
    } else if (name == "vertex_sources") {
        list_vertex_sources(bytes, blob, section, listing);
    } else if (name == "source_origin") {
        list_source_origin(bytes, listing);
    }
}

}  // namespace

void list_blob_header(Bytes bytes, ByteListing& listing) { list_header(bytes, fields_of(bytes), listing); }

void list_blob(Bytes bytes, const Blob& blob, ByteListing& listing) {
    for (const Section& section : sections_of(blob)) {
        if (section.bytes > 0 && !listing.full()) list_section(bytes, blob, section, listing);
    }
}

}  // namespace espalier::tools
