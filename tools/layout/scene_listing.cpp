#include "listing.hpp"

#include <espalier/format.hpp>

#include <import/base/numbers.hpp>

namespace espalier::tools {

namespace {

constexpr HeaderField scene_header_fields[] = {
    {format::scene::magic_at, 4, "magic", HeaderField::Kind::text},
    {format::scene::version_major_at, 2, "format version of scenes, major", HeaderField::Kind::integer},
    {format::scene::version_minor_at, 2, "format version of scenes, minor", HeaderField::Kind::integer},
    {format::scene::total_bytes_at, 4, "bytes in all", HeaderField::Kind::integer},
    {format::scene::checksum_at, 4, "checksum", HeaderField::Kind::hexadecimal},
    {format::scene::features_at, 4, "features", HeaderField::Kind::hexadecimal},
    {format::scene::depth_at, 1, "depth", HeaderField::Kind::integer},
    {format::scene::depth_at + 1, 1, "reserved", HeaderField::Kind::zero},
    {format::scene::step_exponent_at, 2, "step exponent", HeaderField::Kind::signed_integer},
    {format::scene::mesh_count_at, 4, "meshes", HeaderField::Kind::integer},
    {format::scene::instance_count_at, 4, "instances", HeaderField::Kind::integer},
    {format::scene::node_count_at, 4, "nodes", HeaderField::Kind::integer},
    {format::scene::tile_count_at, 4, "tiles", HeaderField::Kind::integer},
    {format::scene::origin_at, 12, "origin", HeaderField::Kind::real},
    {format::scene::extent_at, 12, "extent in steps", HeaderField::Kind::integer},
    {format::scene::max_error_at, 4, "max error", HeaderField::Kind::real},
    {format::scene::common_origin_at, 12, "common lattice: origin", HeaderField::Kind::real},
    {format::scene::common_extent_at, 12, "common lattice: extent in steps", HeaderField::Kind::integer},
    {format::scene::common_step_exponent_at, 2, "common lattice: step exponent", HeaderField::Kind::signed_integer},
    {format::scene::common_step_exponent_at + 2, 2, "reserved", HeaderField::Kind::zero},
    {format::scene::tile_mesh_count_at, 4, "meshes in tiles", HeaderField::Kind::integer},
    {format::scene::zeros_at, 4, "reserved", HeaderField::Kind::zero},
    {format::scene::source_origin_at, 24, "source origin", HeaderField::Kind::real64},
};

std::string floats_text(Bytes bytes, std::size_t at, unsigned count) {
    std::string result;
    for (unsigned i = 0; i < count; ++i) result += text(' ', read_f32(bytes, at + 4 * i));
    return result;
}

void list_instance(Bytes bytes, std::uint32_t number, ByteListing& listing) {
    namespace field = format::scene;
    const std::size_t at = listing.at();
    const auto integer = [&](std::size_t field_at) { return read_u32(bytes, at + field_at); };
    listing.field(16, text("instance ", number, ": rotation x y z w", floats_text(bytes, at + field::rotation_at, 4)));
    listing.field(12, text("translation", floats_text(bytes, at + field::translation_at, 3)));
    listing.field(4, text("scale", floats_text(bytes, at + field::scale_at, 1)));
    listing.field(4, text("mesh ", integer(field::mesh_at)));
    listing.field(4, text("mask ", checksum_text(integer(field::mask_at))));
    listing.field(4, text("user ", integer(field::user_at)));
    listing.field(4, text("source ", integer(field::source_at)));
}

}  // namespace

void list_scene_header(Bytes bytes, ByteListing& listing) { list_header(bytes, scene_header_fields, listing); }

void list_scene(Bytes bytes, const BakedScene& scene, ByteListing& listing) {
    const SceneLayout layout = layout_of(bytes, scene);
    const auto name = [&](std::size_t i) {
        return i < layout.mesh_count ? text("mesh ", i) : text("tile ", i - layout.mesh_count);
    };
    list_scene_header(bytes, listing);
    listing.heading("sizes of meshes and tiles");
    for (std::size_t i = 0; i < layout.parts.size() && !listing.full(); ++i)
        listing.field(format::scene::part_size_bytes, text(name(i), " has ", counted(layout.parts[i].bytes, "byte")));
    for (std::size_t i = 0; i < layout.parts.size() && !listing.full(); ++i) {
        const ScenePart& place = layout.parts[i];
        listing.field_up_to(place.at, "padding");
        listing.heading(name(i));
        const ByteListing::Part part(listing);
        const Bytes inner = bytes.subspan(place.at, place.bytes);
        if (i < layout.mesh_count) list_blob(inner, scene.meshes()[i], listing);
        else list_scene(inner, scene.tiles()[i - layout.mesh_count], listing);
    }
    if (listing.full()) return;
    listing.field_up_to(layout.nodes.at, "padding");
    if (scene.instance_count() == 0) return;
    listing.heading("nodes");
    for (std::size_t at = layout.nodes.at; at < layout.instances.at && !listing.full();
         at += format::packed_node::bytes) {
        const std::size_t number = (at - layout.nodes.at) / format::packed_node::bytes;
        list_packed_node(bytes, read_packed_node(bytes, at), number, {"instances", "first instance "}, listing);
    }
    if (listing.full()) return;
    listing.heading("instances");
    for (std::uint32_t i = 0; i < scene.instance_count() && !listing.full(); ++i) list_instance(bytes, i, listing);
}

}  // namespace espalier::tools
