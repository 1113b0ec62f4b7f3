#include "policy.hpp"

#include <algorithm>

#include <import/base/numbers.hpp>

#include "layout/places.hpp"
#include "report/source_point.hpp"

namespace espalier::tools {

namespace {

struct NamedVolume {
    const char* key;
    const char* what;
    double volume;
};

/// Returns the volumes of the bounds that the options store.
std::vector<NamedVolume> volumes_of(const BakeReport& report) {
    std::vector<NamedVolume> stored;
    for (const NamedVolume& volume : {NamedVolume{"oriented_box", "oriented box", report.bounds.volumes.oriented_box},
                                      NamedVolume{"sphere", "sphere", report.bounds.volumes.sphere},
                                      NamedVolume{"k_dop", "26-DOP", report.bounds.volumes.k_dop}}) {
        if (volume.volume > 0.0) stored.push_back(volume);
    }
    return stored;
}

/// Prints the numbers and names of a file's first meshes or materials, "0 floor, 1 walls", if it names any.
void say_names(const Console& console, const char* what, const std::vector<std::string>& names,
               std::uint64_t first_number = 0) {
    constexpr std::size_t most = 16;
    if (std::all_of(names.begin(), names.end(), [](const auto& name) { return name.empty(); })) return;
    std::string listed;
    for (std::size_t i = 0; i < std::min(names.size(), most); ++i) {
        listed += text(i == 0 ? "" : ", ", first_number + i);
        if (!names[i].empty()) listed += text(' ', printable(names[i]));
    }
    console.say("  ", what, ": ", listed, names.size() > most ? ", ...; --json lists all of them" : "");
}

/// How many triangles each mesh and each material has, at all places.
struct SourceCounts {
    std::vector<Json> of_meshes;              ///< a list for each file, in the order of their numbers
    std::vector<std::uint64_t> of_materials;  ///< by number
};

SourceCounts counts_of(const ImportResult& imported) {
    SourceCounts counts{std::vector<Json>(imported.files.size(), Json::array()), {}};
    for (const ImportedFile& file : imported.files)
        counts.of_materials.resize(counts.of_materials.size() + file.materials);
    std::vector<std::uint64_t> places(imported.meshes.size(), imported.places.empty() ? 1 : 0);
    for (const ImportedPlace& place : imported.places) {
        counts.of_meshes[place.file].push_back(imported.meshes[place.mesh].triangles.size());
        ++places[place.mesh];
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
        const ImportedMesh& mesh = imported.meshes[i];
        if (imported.places.empty()) counts.of_meshes[mesh.file].push_back(mesh.triangles.size());
        for (const std::uint32_t material : mesh.materials)  // a broken file may state one that it does not have
            if (material < counts.of_materials.size()) counts.of_materials[material] += places[i];
    }
    return counts;
}

/// In the order of their numbers, which go on from file to file.
Json materials_json(const ImportResult& imported, const SourceCounts& counts) {
    Json materials = Json::array();
    for (std::size_t file = 0; file < imported.files.size(); ++file)
        for (const std::string& name : imported.files[file].material_names) {
            const std::size_t number = materials.elements().size();
            materials.push_back(
                {{"number", number}, {"file", file}, {"name", name}, {"triangles", counts.of_materials[number]}});
        }
    return materials;
}

double bytes_per_baked_triangle(const BakeReport& report) {
    return report.tree.triangles == 0 ? 0.0 : static_cast<double>(report.bytes) / report.tree.triangles;
}

constexpr double largest_expected_extent = 1000.0;  // metres
constexpr double smallest_expected_extent = 0.001;

/// Of each BakeWarning::Kind.
constexpr const char* names_of_kinds[] = {"step_below_float_spacing", "lost_closed", "rays_rounded_coarsely"};

}  // namespace

void say_import(const Console& console, const BakeArguments& arguments, const ImportResult& imported) {
    std::uint64_t first_material = 0;
    for (const ImportedFile& file : imported.files) {
        console.say(printable(file.path), ": ", counted(file.triangles, "triangle"), " in ",
                    counted(file.meshes, "mesh"), file.format.empty() ? "" : text(", ", file.format));
        console.say("  unit: 1 = ", file.metres_per_unit, " m (", file.unit_origin, ")",
                    arguments.source.scale == 1.0 ? "" : text(", then scaled by ", arguments.source.scale));
        say_names(console, "meshes", file.mesh_names);
        if (arguments.materials) say_names(console, "materials", file.material_names, first_material);
        first_material += file.materials;
        if (file.points_and_lines > 0) {
            console.say("  skipped ", file.points_and_lines, " points and lines: no surface");
        }
    }
    console.say(arguments.source.up ? text("axes: ", axis_name(*arguments.source.up), " of the input is +Y in the blob")
                                    : std::string("axes: as imported (--up turns another axis to +Y)"));
}

void say_findings(const Console& console, const BakeReport& report) {
    for (const DropReason& reason : drop_reasons) {
        const Finding& found = report.findings.*reason.finding;
        if (found.count == 0) continue;
        console.say("dropped ", counted(found.count, "triangle"), ' ', reason.words, "; first: ", found.first);
    }
}

void say_report(const Console& console, const BakeReport& report) {
    say_findings(console, report);
    if (report.tree.triangles == 0) {
        console.say(report.source.triangles == 0 ? "the input has no triangles" : "no triangle is left",
                    "; the blob is valid and empty, and every query of it finds nothing");
    }
    if (report.origin != Vec3d{}) {
        console.say("origin: ", words_for_origin(report.origin),
                    " of the source is 0 0 0 of the blob, from which its coordinates and the bounds count");
    }
    console.say("bounds: ", shortest(report.bounds.min), " to ", shortest(report.bounds.max), ", extent ",
                rounded(report.bounds.extent));
    console.say("lattice: ", report.lattice.bits, " bits, step ", rounded(report.lattice.step), ", max error ",
                rounded(report.lattice.max_error), " (from the source's coordinates)");
    console.say("tree: ", counted(report.tree.triangles, "triangle"), ", ", counted(report.tree.vertices, "vertex"),
                ", ", counted(report.tree.nodes, "node"), ", ", counted(report.tree.leaves, "leaf"), ", depth ",
                report.tree.depth, report.closed ? ", closed" : ", not closed");
    console.say("size: ", counted(report.bytes, "byte"), ", ", rounded(bytes_per_baked_triangle(report), 4),
                " per triangle");
    if (report.motion.positions != 0) {
        console.say("motion: ", counted(report.motion.positions, "position"), " in the range ",
                    shortest(report.motion.range.min), " to ", shortest(report.motion.range.max), "; ",
                    counted(report.motion.moving_bytes, "byte"), " move, ",
                    rounded(static_cast<double>(report.motion.moving_bytes) / report.tree.triangles, 4),
                    " per triangle");
    }
    if (report.bounds.volumes.box > 0.0) {
        std::string volumes = text("volume: axis-aligned box ", rounded(report.bounds.volumes.box, 4));
        for (const NamedVolume& volume : volumes_of(report)) {
            volumes += text(", ", volume.what, ' ', rounded(volume.volume, 4), " (",
                            rounded(100.0 * volume.volume / report.bounds.volumes.box, 3), " %)");
        }
        console.say(volumes);
    }
}

Json input_json(const BakeArguments& arguments, const ImportResult& imported) {
    Json document = json_document();
    document["output"] = arguments.output;
    const SourceCounts counts = counts_of(imported);
    Json inputs = Json::array();
    for (const ImportedFile& file : imported.files) {
        inputs.push_back({{"file", file.path},
                          {"format", file.format},
                          {"meshes", file.meshes},
                          {"mesh_names", file.mesh_names},
                          {"mesh_paths", file.mesh_paths},
                          {"mesh_triangles", counts.of_meshes[inputs.elements().size()]},
                          {"triangles", file.triangles},
                          {"points_and_lines", file.points_and_lines},
                          {"metres_per_unit", file.metres_per_unit},
                          {"unit_origin", file.unit_origin}});
    }
    document["inputs"] = std::move(inputs);
    if (arguments.materials) document["materials"] = materials_json(imported, counts);
    document["scale"] = arguments.source.scale;
    document["up"] = arguments.source.up ? Json(axis_name(*arguments.source.up)) : Json(nullptr);
    return document;
}

Json findings_json(const BakeReport& report) {
    Json findings = Json::object();
    for (const DropReason& reason : drop_reasons) {
        const Finding& found = report.findings.*reason.finding;
        findings[reason.key] = {{"count", found.count},
                                {"first", found.count == 0 ? Json(nullptr) : Json(found.first)}};
    }
    return findings;
}

Json bake_json(const BakeArguments& arguments, const ImportResult& imported, const BakeReport& report, const Blob& blob,
               std::span<const Warning> warnings) {
    Json document = input_json(arguments, imported);
    document["source_triangles"] = report.source.triangles;
    document["source_vertices"] = report.source.vertices;
    document["triangles"] = report.tree.triangles;
    document["vertices"] = report.tree.vertices;
    document["findings"] = findings_json(report);
    if (report.origin != Vec3d{}) document["source_origin"] = json_point(report.origin);
    document["bounds"] = json_box(report.bounds.min, report.bounds.max);
    Json volumes = Json::object();
    if (report.bounds.volumes.box > 0.0) volumes["box"] = report.bounds.volumes.box;
    for (const NamedVolume& volume : volumes_of(report)) volumes[volume.key] = volume.volume;
    document["volumes"] = std::move(volumes);
    document["extent"] = report.bounds.extent;
    document["bits"] = report.lattice.bits;
    document["step"] = report.lattice.step;
    document["max_error"] = report.lattice.max_error;
    document["step_below_float_spacing"] = report.warns_of(BakeWarning::Kind::step_below_float_spacing);
    document["bytes"] = report.bytes;
    document["bytes_per_triangle"] = bytes_per_baked_triangle(report);
    document["nodes"] = report.tree.nodes;
    document["leaves"] = report.tree.leaves;
    document["depth"] = report.tree.depth;
    document["closed"] = report.closed;
    document["lost_closed"] = report.warns_of(BakeWarning::Kind::lost_closed);
    document["bits_that_keep_closed"] =
        report.bits_that_keep_closed == 0 ? Json(nullptr) : Json(report.bits_that_keep_closed);
    document["rays_rounded_coarsely"] = report.warns_of(BakeWarning::Kind::rays_rounded_coarsely);
    document["profile"] = name_of(blob.profile());
    document["deformable"] = blob.is_deformable();
    if (blob.is_deformable()) document["motion"] = motion_json(blob);
    document["checksum"] = checksum_text(blob.checksum());
    document["warnings"] = warnings_json(warnings);
    return document;
}

std::vector<Warning> bake_warnings(const BakeReport& report, const AssetPolicy& policy, const ImportResult& imported) {
    std::vector<Warning> warnings;
    const std::string file = only_input(imported);
    const auto add = [&](const char* kind, const std::string& message) { warnings.push_back({kind, message, file}); };
    for (const BakeWarning& warning : report.warnings)
        add(names_of_kinds[static_cast<std::size_t>(warning.kind)], warning.message);
    if (report.tree.triangles == 0 || policy.expected_size) return warnings;
    const double extent = report.bounds.extent;
    if (extent > largest_expected_extent || extent < smallest_expected_extent) {
        add("unexpected_size",
            text(names_of_inputs(imported), ": the asset is ", rounded(extent),
                 " m across. If that is not what it is, give the unit of its file with --unit, or --scale."));
    }
    return warnings;
}

}  // namespace espalier::tools
