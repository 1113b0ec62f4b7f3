#include "places.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include <espalier/deformation.hpp>
#include <baker/sections/edge_flags.hpp>
#include <import/base/numbers.hpp>
#include <runtime/blob/id_steps.hpp>

#include "base/choices.hpp"
#include "base/exit_code.hpp"

namespace espalier::tools {

namespace {

std::size_t padded_to_4(std::size_t bytes) { return (bytes + 3) / 4 * 4; }

std::size_t sum_of(std::span<const ScenePart> parts) {
    std::size_t sum = 0;
    for (const ScenePart& part : parts) sum += part.bytes;
    return sum;
}

}  // namespace

std::uint32_t read_bits(Bytes bytes, std::size_t bit, unsigned width) {
    std::uint32_t value = 0;
    for (unsigned i = 0; i < width; ++i, ++bit)
        value |= ((std::to_integer<std::uint32_t>(bytes[bit / 8]) >> (bit % 8)) & 1u) << i;
    return value;
}

unsigned vertex_source_bits(const Blob& blob) {
    const detail::BlobData& data = detail::data_of(blob);
    return format::vertex_sources::number_bits(read_u32({data.bytes, data.size}, format::header::position_count_at));
}

std::vector<Section> sections_of(const Blob& blob) {
    const detail::BlobData& data = detail::data_of(blob);
    std::vector<Section> sections;
    std::size_t at = 0;
    const auto add = [&](const char* name, std::size_t bytes) {
        sections.push_back({name, at, bytes});
        at += bytes;
    };
    add("header", format::header::bytes);
    add("nodes", data.node_count * format::node_bytes(data.profile));
    add("leaves", data.leaf_bytes);
    add("guard", format::guard_bytes);
    if ((data.features & format::feature::original_ids) != 0) {
        add("sources", std::size_t{data.source_count} * format::source::bytes);
        add("original_ids",
            static_cast<std::size_t>(detail::id_block(data, format::ids::block_count(data.triangle_count)) - data.ids));
    }
    if ((data.features & format::feature::materials_8) != 0) add("materials", padded_to_4(data.triangle_count));
    if ((data.features & format::feature::materials_16) != 0) {
        add("materials", padded_to_4(std::size_t{data.triangle_count} * 2));
    }
    if (data.copies != nullptr) {
        add("copies", format::copies::blocks_at + format::copies::blocks_bytes(data.triangle_count) +
                          format::copies::owner_bytes * std::size_t{data.copy_count});
    }
    if (data.edge_flags != nullptr) {
        using namespace format::edge_flags;
        add("edge_flags", padded_to_4(fields_at + (std::size_t{data.triangle_count} * triangle_bits + 7) / 8));
    }
    if ((data.features & format::feature::oriented_box) != 0) add("oriented_box", format::bounds::oriented_box_bytes);
    if ((data.features & format::feature::bounding_sphere) != 0) add("sphere", format::bounds::sphere_bytes);
    if ((data.features & format::feature::k_dop) != 0) add("k_dop", format::bounds::k_dop_bytes);
    if (blob.is_deformable()) {
        add("corners", format::corners::padded_bytes(data.triangle_count) + format::corners::guard_bytes);
        add("vertex_sources", padded_to_4(read_u32({data.bytes, data.size}, format::header::vertex_slots_at) *
                                          std::size_t{vertex_source_bits(blob) / 8}));
    }
    if ((data.features & format::feature::source_origin) != 0) add("source_origin", format::source_origin::bytes);
    if (at != data.size) {
        throw_error(ExitCode::internal, "the sections do not add up to the blob: please report this blob.");
    }
    return sections;
}

const Section& section_named(const std::vector<Section>& sections, std::string_view name) {
    for (const Section& section : sections) {
        if (section.name == name) return section;
    }
    throw_error(ExitCode::internal, "a section is missing: please report this blob.");
}

NodeFields read_packed_node(Bytes bytes, std::size_t at) {
    namespace field = format::packed_node;
    const std::uint32_t children = read_u32(bytes, at + field::children_at);
    return {at, children & 0xFFFFFFu, (children >> 24) & 15u, children >> 28,
            read_u32(bytes, at + field::leaf_block_at)};
}

NodeFields read_node(Bytes bytes, const Blob& blob, std::size_t node) {
    NodeFields fields{};
    fields.at = format::header::bytes + node * format::node_bytes(blob.profile());
    if (format::has_plain_nodes(blob.profile())) {
        namespace field = format::plain_node;
        const std::uint32_t children = read_u32(bytes, fields.at + field::children_at);
        fields.first_child = children & 0xFFFFFFu;
        fields.node_children = children >> 24;
        fields.leaves = read_u8(bytes, fields.at + field::leaf_children_at);
        fields.leaf_block = read_u32(bytes, fields.at + field::leaf_block_at);
    } else {
        fields = read_packed_node(bytes, fields.at);
    }
    return fields;
}

unsigned read_shift(Bytes bytes, std::size_t at, unsigned axis) {
    return (read_u16(bytes, at + format::packed_node::shifts_at) >> (5 * axis)) & 31u;
}

std::uint32_t side_of_child(Bytes bytes, std::size_t at, unsigned child, unsigned axis) {
    namespace field = format::packed_node;
    const std::size_t plane = at + field::row_bytes * axis + child;
    const std::uint32_t planes = read_u8(bytes, plane + field::hi_at) - read_u8(bytes, plane + field::lo_at);
    return planes << read_shift(bytes, at, axis);
}

LeafFields read_leaf(Bytes bytes, const Blob& blob, std::size_t at, unsigned leaf) {
    namespace field = format::plain_leaf;
    const std::uint32_t descriptor =
        read_bits(bytes, 8 * (at + format::plain_node::leaves_at + field::descriptor_bytes * leaf), 24);
    LeafFields fields{};
    fields.data_offset = descriptor & ((1u << field::offset_bits) - 1);
    fields.triangles = ((descriptor >> field::triangles_shift) & 15u) + 1;
    fields.vertices = ((descriptor >> field::vertices_shift) & 31u) + 1;
    fields.size_bits = (descriptor >> field::size_shift) + field::least_size(detail::data_of(blob).bits);
    return fields;
}

StripFields read_strip(std::uint32_t descriptor) {
    namespace field = format::strip_leaf;
    return {descriptor & ((1u << field::offset_bits) - 1), (descriptor >> field::entries_shift & 63u) + 3,
            descriptor >> field::first_shift};
}

PredictedFields read_predicted_strip(std::uint32_t descriptor) {
    namespace field = format::predicted_strip;
    return {descriptor & ((1u << field::entries_shift) - 1), (descriptor >> field::entries_shift) + 3};
}

/// Both kinds of strips differ in what states which windows are triangles, before the first uses or behind.
StripMarks read_marks(Bytes bytes, std::size_t at, unsigned entries, bool is_predicted) {
    namespace predicted = format::predicted_strip;
    std::size_t bit = 8 * at + (is_predicted ? predicted::joints_at : 0);
    const auto take = [&](unsigned width) {
        bit += width;
        return read_bits(bytes, bit - width, width);
    };
    StripMarks marks{};
    std::vector<bool> first_uses(entries, true);
    marks.pivots.resize(entries, false);
    marks.triangles.resize(entries - 2, true);
    marks.pivots[0] = true;
    const std::uint32_t joints = is_predicted ? take(predicted::joint_count_bits) : 0;
    for (unsigned i = 1; i + 2 < entries; ++i) marks.pivots[i] = take(1) != 0;
    for (unsigned i = 1; i + 2 < entries && !is_predicted; ++i) marks.triangles[i] = take(1) != 0;
    for (unsigned i = 3; i < entries; ++i) first_uses[i] = take(1) != 0;
    for (std::uint32_t joint = 0; joint < joints; ++joint) {
        const std::uint32_t window = take(predicted::place_bits);
        marks.triangles[window] = marks.triangles[window + 1] = false;
    }
    for (const bool first_use : first_uses) marks.vertices += first_use ? 1 : 0;
    std::uint32_t used = 0;
    for (unsigned i = 0; i < entries; ++i) {
        marks.entries.push_back(first_uses[i] ? used++ : take(format::strip_leaf::reference_width(marks.vertices)));
    }
    marks.bits = bit - 8 * at;
    return marks;
}

std::uint64_t leaf_count(Bytes bytes, const Blob& blob) {
    std::uint64_t count = 0;
    for (std::size_t node = 0; node < detail::data_of(blob).node_count; ++node) {
        count += read_node(bytes, blob, node).leaves;
    }
    return count;
}

const std::string& name_of(Profile profile) { return name_in(profile_choices, profile); }

std::string checksum_text(std::uint32_t checksum) {
    constexpr char digits[] = "0123456789abcdef";
    std::string result;
    for (int shift = 28; shift >= 0; shift -= 4) result += digits[(checksum >> shift) & 15u];
    return result;
}

std::vector<std::string> feature_names(std::uint32_t features) {
    constexpr const char* of_bits[] = {"original_ids", "materials_8",  "materials_16",    "closed", "split_references",
                                       "edge_flags",   "oriented_box", "bounding_sphere", "k_dop",  "deformable",
                                       "id_runs",      "source_origin"};
    static_assert(format::feature::known == (1u << std::size(of_bits)) - 1);
    std::vector<std::string> names;
    for (std::size_t bit = 0; bit < std::size(of_bits); ++bit)
        if ((features >> bit & 1u) != 0) names.emplace_back(of_bits[bit]);
    return names;
}

Motion motion_of(const Blob& blob) {
    std::vector<std::byte> memory(deformable_bytes(blob));
    const Deformable mesh = create_deformable(blob, memory);
    return {mesh.position_count(), mesh.range(), memory.size()};
}

std::optional<double> flat_angle_of(const Blob& blob) {
    const detail::BlobData& data = detail::data_of(blob);
    if (!blob.has_edge_flags()) return std::nullopt;
    const std::uint32_t limit = detail::load_u32(data.edge_flags + format::edge_flags::flat_limit_at);
    if (limit == 0) return 0.0;
    const double squared_sine = (limit + 0.5) / format::edge_flags::max_flat_limit;  // it was rounded down
    const double angle = std::asin(std::sqrt(std::min(squared_sine, 1.0))) * 180.0 / std::numbers::pi;
    for (int digits = 1; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
        const double shorter = parse_double(rounded(angle, digits)).value_or(angle);
        if (shorter < 90.0 && baker::flat_limit_of(shorter) == limit) return shorter;
    }
    return angle;
}

Json motion_json(const Blob& blob) {
    const Motion motion = motion_of(blob);
    return {{"positions", motion.positions},
            {"range", json_box(motion.range.min, motion.range.max)},
            {"moving_bytes", motion.moving_bytes},
            {"moving_bytes_per_triangle", static_cast<double>(motion.moving_bytes) / blob.triangle_count()}};
}

std::size_t SceneLayout::mesh_bytes() const { return sum_of(std::span(parts).first(mesh_count)); }
std::size_t SceneLayout::tile_bytes() const { return sum_of(std::span(parts).subspan(mesh_count)); }

SceneLayout layout_of(Bytes bytes, const BakedScene& scene) {
    using namespace format::scene;
    SceneLayout layout{};
    layout.mesh_count = scene.meshes().size();
    const std::size_t count = layout.mesh_count + scene.tiles().size();
    layout.part_sizes = {header_bytes, count * part_size_bytes};
    std::size_t at = layout.part_sizes.at + layout.part_sizes.bytes;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t begin = aligned(at);
        layout.parts.push_back({begin, read_u32(bytes, header_bytes + i * part_size_bytes)});
        layout.padding += begin - at;
        at = begin + layout.parts.back().bytes;
    }
    layout.nodes = {aligned(at), detail::data_of(scene).tree.node_count * format::packed_node::bytes};
    layout.padding += layout.nodes.at - at;
    layout.instances = {layout.nodes.at + layout.nodes.bytes, scene.instance_count() * instance_bytes};
    return layout;
}

}  // namespace espalier::tools
