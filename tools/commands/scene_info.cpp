#include "commands.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <optional>
#include <string>

#include <espalier/scene.hpp>

#include <import/base/numbers.hpp>

#include "files/blob_file.hpp"
#include "layout/places.hpp"
#include "layout/tree_quality.hpp"
#include "report/diagnostics.hpp"
#include "report/json.hpp"
#include "report/source_point.hpp"
#include "scenes/plan.hpp"

namespace espalier::tools {

namespace {

constexpr std::size_t most_parts_listed = 16;
constexpr double bytes_around_flattened = format::header::bytes + format::guard_bytes;

/// A mesh or a tile, and what all its instances come to.
struct PartUse {
    std::uint64_t instances = 0;
    float least_scale = 0.0f;
    float largest_scale = 0.0f;
};

struct SceneFigures {
    SceneLayout layout;
    std::vector<PartUse> uses;  ///< of each mesh, then of each tile
    std::uint64_t triangles = 0;
    double flattened_bytes = 0.0;
};

SceneFigures figures_of(std::span<const std::byte> bytes, const BakedScene& scene);

/// Returns the bytes that the triangles of a mesh or of a tile take in a larger blob.
double bytes_as_part_of_blob(std::span<const std::byte> bytes, const BakedScene& scene, std::size_t part) {
    const std::size_t meshes = scene.meshes().size();
    if (part < meshes) return bytes_as_part(bytes, scene.meshes()[part]);
    return figures_of(bytes, scene.tiles()[part - meshes]).flattened_bytes - bytes_around_flattened;
}

/// Of a blob with the triangles of all instances: an estimate, for the steps that the meshes have.
double flattened_bytes(std::span<const std::byte> bytes, const BakedScene& scene, const SceneFigures& figures) {
    double sum = bytes_around_flattened;
    for (std::size_t i = 0; i < figures.uses.size(); ++i) {
        const ScenePart& part = figures.layout.parts[i];
        sum += static_cast<double>(figures.uses[i].instances) *
               bytes_as_part_of_blob(bytes.subspan(part.at, part.bytes), scene, i);
    }
    return std::round(sum);
}

/// Returns the triangles of a mesh or, after the meshes, of all instances of a tile.
std::uint64_t triangles_of_part(const BakedScene& scene, std::size_t part) {
    const std::size_t meshes = scene.meshes().size();
    if (part < meshes) return scene.meshes()[part].triangle_count();
    const BakedScene& tile = scene.tiles()[part - meshes];
    std::uint64_t sum = 0;
    for (std::uint32_t i = 0; i < tile.instance_count(); ++i) sum += mesh_at(tile, {i})->triangle_count();
    return sum;
}

SceneFigures figures_of(std::span<const std::byte> bytes, const BakedScene& scene) {
    SceneFigures figures;
    figures.layout = layout_of(bytes, scene);
    figures.uses.resize(figures.layout.parts.size());
    for (std::uint32_t i = 0; i < scene.instance_count(); ++i) {
        const Instance instance = *instance_at(scene, {i});
        PartUse& use = figures.uses[instance.mesh];
        const float scale = instance.transform.scale;
        use.least_scale = use.instances == 0 ? scale : std::min(use.least_scale, scale);
        use.largest_scale = std::max(use.largest_scale, scale);
        ++use.instances;
    }
    for (std::size_t part = 0; part < figures.uses.size(); ++part)
        figures.triangles += figures.uses[part].instances * triangles_of_part(scene, part);
    figures.flattened_bytes = flattened_bytes(bytes, scene, figures);
    return figures;
}

std::string scene_format_version(std::span<const std::byte> bytes) {
    return text(read_u16(bytes, format::scene::version_major_at), '.',
                read_u16(bytes, format::scene::version_minor_at));
}

float lattice_step_of(const BakedScene& scene) { return std::ldexp(1.0f, detail::data_of(scene).tree.step_exponent); }

std::uint32_t node_count(const BakedScene& scene) { return detail::data_of(scene).tree.node_count; }

/// Returns how many instances lie on the common lattice.
std::uint32_t instances_on_common_lattice(const BakedScene& scene) {
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < scene.instance_count(); ++i) count += is_on_common_lattice(scene, {i}).yes();
    return count;
}

std::vector<NamedBytes> scene_sections_of(const SceneLayout& layout) {
    return {{"header", format::scene::header_bytes},
            {"part_sizes", layout.part_sizes.bytes},
            {"meshes", layout.mesh_bytes()},
            {"tiles", layout.tile_bytes()},
            {"nodes", layout.nodes.bytes},
            {"instances", layout.instances.bytes},
            {"padding", layout.padding}};
}

void print_scene_json(const InfoArguments& arguments, std::span<const std::byte> bytes, const BakedScene& scene) {
    const SceneFigures figures = figures_of(bytes, scene);
    Json document = json_document();
    document["file"] = arguments.blob;
    document["scene_version"] = scene_format_version(bytes);
    document["instances"] = scene.instance_count();
    document["triangles"] = figures.triangles;
    document["bytes"] = scene.size();
    document["flattened_bytes"] = figures.flattened_bytes;
    Json sections = Json::object();
    for (const NamedBytes& section : scene_sections_of(figures.layout)) sections[section.name] = section.bytes;
    document["sections"] = std::move(sections);
    document["step"] = json_number(lattice_step_of(scene));
    document["max_error"] = json_number(scene.max_error());
    if (scene.source_origin() != Vec3d{}) document["source_origin"] = json_point(scene.source_origin());
    document["bounds"] = json_box(scene.bounds().min, scene.bounds().max);
    if (const auto common = scene.common_lattice()) {
        document["common_lattice"] = {{"step", json_number(std::ldexp(1.0f, common->step_exponent))},
                                      {"origin", json_point(common->origin)},
                                      {"extent", common->extent},
                                      {"instances", instances_on_common_lattice(scene)}};
    } else {
        document["common_lattice"] = nullptr;
    }
    document["depth"] = unsigned{detail::data_of(scene).tree.depth};
    document["nodes"] = node_count(scene);
    Json meshes = Json::array();
    for (std::size_t i = 0; i < scene.meshes().size(); ++i) {
        const Blob& mesh = scene.meshes()[i];
        const PartUse& use = figures.uses[i];
        Json& listed = meshes.push_back({{"instances", use.instances},
                                         {"triangles", mesh.triangle_count()},
                                         {"bytes", mesh.size()},
                                         {"profile", name_of(mesh.profile())},
                                         {"step", json_number(std::ldexp(1.0f, mesh.lattice().step_exponent))},
                                         {"max_error", json_number(mesh.max_error())},
                                         {"least_scale", json_number(use.least_scale)},
                                         {"largest_scale", json_number(use.largest_scale)},
                                         {"checksum", checksum_text(mesh.checksum())}});
        if (const std::optional<double> angle = flat_angle_of(mesh)) listed["flat_angle"] = *angle;
        if (arguments.histogram) listed["tree_quality"] = tree_quality_json(tree_quality_of(mesh));
    }
    document["meshes"] = std::move(meshes);
    Json tiles = Json::array();
    for (std::size_t i = 0; i < scene.tiles().size(); ++i) {
        const BakedScene& tile = scene.tiles()[i];
        tiles.push_back({{"instances", figures.uses[scene.meshes().size() + i].instances},
                         {"instances_in_tile", tile.instance_count()},
                         {"meshes", tile.meshes().size()},
                         {"bytes", tile.size()},
                         {"max_error", json_number(tile.max_error())},
                         {"checksum", checksum_text(detail::data_of(tile).tree.checksum)}});
    }
    document["tiles"] = std::move(tiles);
    document["checksum"] = checksum_text(detail::data_of(scene).tree.checksum);
    print_json(document);
}

/// Returns ", flat angle 5 degrees"; nothing without edge flags.
std::string words_for_flat_angle(const Blob& mesh) {
    const std::optional<double> angle = flat_angle_of(mesh);
    return angle ? text(", flat angle ", *angle, " degrees") : std::string();
}

void print_meshes(const BakedScene& scene, const SceneFigures& figures) {
    const std::size_t meshes = scene.meshes().size();
    for (std::size_t i = 0; i < figures.uses.size() && i < most_parts_listed; ++i) {
        const PartUse& use = figures.uses[i];
        if (i >= meshes) {
            const BakedScene& tile = scene.tiles()[i - meshes];
            print_line(text("tile ", i - meshes), counted(use.instances, "instance"), ", in it ",
                       counted(tile.instance_count(), "instance"), " of ", counted(tile.meshes().size(), "mesh"), ", ",
                       counted(tile.size(), "byte"), ", max error ", shortest(tile.max_error()));
            continue;
        }
        const Blob& mesh = scene.meshes()[i];
        const std::string scales = use.least_scale == use.largest_scale
                                       ? text("scale ", use.least_scale)
                                       : text("scales ", use.least_scale, " to ", use.largest_scale);
        print_line(text("mesh ", i), counted(use.instances, "instance"), ", ",
                   counted(mesh.triangle_count(), "triangle"), ", ", counted(mesh.size(), "byte"), ", step ",
                   shortest(std::ldexp(1.0f, mesh.lattice().step_exponent)), ", max error ", shortest(mesh.max_error()),
                   ", ", scales, words_for_flat_angle(mesh));
    }
    if (figures.uses.size() > most_parts_listed) print_line("...", "--json lists all");
}

void print_tree_qualities(const BakedScene& scene) {
    for (std::size_t i = 0; i < scene.meshes().size(); ++i) {
        std::cout << "mesh " << i << '\n';
        print_tree_quality(tree_quality_of(scene.meshes()[i]));
    }
    if (!scene.tiles().empty()) std::cout << "the meshes of tiles: info --histogram for the file of each tile\n";
}

void print_scene_table(const InfoArguments& arguments, std::span<const std::byte> bytes, const BakedScene& scene) {
    const SceneFigures figures = figures_of(bytes, scene);
    std::cout << printable(arguments.blob) << '\n';
    print_line("format", "scene ", scene_format_version(bytes));
    print_line("instances", scene.instance_count());
    print_line("meshes", scene.meshes().size());
    if (!scene.tiles().empty()) print_line("tiles", scene.tiles().size());
    print_line("triangles", figures.triangles, " of all instances");
    if (scene.source_origin() != Vec3d{}) {
        print_line("source origin", words_for_origin(scene.source_origin()),
                   " of the source is 0 0 0 of the scene, from which all coordinates here count");
    }
    print_line("bounds", shortest(scene.bounds().min), " to ", shortest(scene.bounds().max));
    print_line("max error", shortest(scene.max_error()));
    print_line("tree", counted(node_count(scene), "node"), ", depth ", unsigned{detail::data_of(scene).tree.depth},
               ", step ", shortest(lattice_step_of(scene)));
    const Result<Lattice> common = scene.common_lattice();
    print_line("common step", common ? text(shortest(std::ldexp(1.0f, common->step_exponent)), ", of ",
                                            counted(instances_on_common_lattice(scene), "instance"))
                                     : "none");
    print_line("checksum", checksum_text(detail::data_of(scene).tree.checksum));
    print_line("flattened", "about ", rounded(figures.flattened_bytes, 10),
               " bytes as one blob with the steps of the meshes: an estimate");
    print_line("bytes", scene.size(), ", of which");
    for (const NamedBytes& section : scene_sections_of(figures.layout)) print_section(section);
    print_meshes(scene, figures);
    if (arguments.histogram) print_tree_qualities(scene);
    finish_standard_output();
}

}  // namespace

void print_scene_info(const InfoArguments& arguments, const AssetFile& file) {
    if (arguments.json) print_scene_json(arguments, file.bytes, file.scene());
    else print_scene_table(arguments, file.bytes, file.scene());
}

}  // namespace espalier::tools
