#include "report.hpp"

#include "base/numbers.hpp"
#include "layout/blob_layout.hpp"
#include "report/diagnostics.hpp"

namespace espalier::tools {

namespace {

struct NamedFinding {
    const char* key;
    const char* what;
    const Finding& finding;
};

std::vector<NamedFinding> findings_of(const BakeReport& report) {
    return {
        {"not_finite", "with a corner that is NaN or infinite", report.not_finite},
        {"index_out_of_range", "with an index out of range", report.index_out_of_range},
        {"zero_area", "without area", report.zero_area},
        {"collapsed", "that the lattice flattened to no area", report.collapsed},
        {"duplicate", "with the corners of another one", report.duplicate},
    };
}

struct NamedVolume {
    const char* key;
    const char* what;
    double volume;
};

/// Of the bounds that were asked for.
std::vector<NamedVolume> volumes_of(const BakeReport& report) {
    std::vector<NamedVolume> asked;
    for (const NamedVolume& volume : {NamedVolume{"oriented_box", "oriented box", report.volumes.oriented_box},
                                      NamedVolume{"sphere", "sphere", report.volumes.sphere},
                                      NamedVolume{"k_dop", "26-DOP", report.volumes.k_dop}}) {
        if (volume.volume > 0.0) asked.push_back(volume);
    }
    return asked;
}

double bytes_per_triangle(const BakeReport& report) {
    return report.triangles == 0 ? 0.0 : static_cast<double>(report.bytes) / report.triangles;
}

}  // namespace

void say_import(const Console& console, const BakeArguments& arguments, const Imported& imported) {
    for (const ImportedFile& file : imported.files) {
        console.say(text(printable(file.path), ": ", counted(file.triangles, "triangle"), " in ",
                         file.meshes == 1 ? std::string("1 mesh") : text(file.meshes, " meshes"),
                         file.format.empty() ? "" : text(", ", file.format)));
        console.say(text("  unit: 1 = ", file.metres_per_unit, " m (", file.unit_origin, ")",
                         arguments.source.scale == 1.0 ? "" : text(", then scaled by ", arguments.source.scale)));
        if (file.points_and_lines > 0) {
            console.say(text("  skipped ", file.points_and_lines, " points and lines: no surface"));
        }
    }
    console.say(arguments.source.up ? text("axes: ", axis_name(*arguments.source.up), " of the input is +Y in the blob")
                                    : std::string("axes: as imported (--up turns another axis to +Y)"));
}

void say_report(const Console& console, const BakeReport& report) {
    for (const NamedFinding& found : findings_of(report)) {
        if (found.finding.count == 0) continue;
        console.say(text("dropped ", counted(found.finding.count, "triangle"), ' ', found.what,
                         "; first: ", found.finding.first));
    }
    if (report.triangles == 0) {
        console.say(text(report.source_triangles == 0 ? "the input has no triangles" : "no triangle is left",
                         "; the blob is valid and empty, and every query of it finds nothing"));
    }
    console.say(text("bounds: ", shortest(report.bounds_min), " to ", shortest(report.bounds_max), ", extent ",
                     rounded(report.extent)));
    console.say(text("lattice: ", report.bits, " bits, step ", rounded(report.step), ", max error ",
                     rounded(report.max_error), " (from the source's coordinates as float32)"));
    console.say(text("tree: ", counted(report.triangles, "triangle"), ", ", counted(report.vertices, "vertex"), ", ",
                     counted(report.nodes, "node"), ", ", report.leaves, report.leaves == 1 ? " leaf" : " leaves",
                     ", depth ", report.depth, report.closed ? ", closed" : ", not closed"));
    console.say(
        text("size: ", counted(report.bytes, "byte"), ", ", rounded(bytes_per_triangle(report), 4), " per triangle"));
    if (report.volumes.box > 0.0) {
        std::string volumes = text("volume: axis-aligned box ", rounded(report.volumes.box, 4));
        for (const NamedVolume& volume : volumes_of(report)) {
            volumes += text(", ", volume.what, ' ', rounded(volume.volume, 4), " (",
                            rounded(100.0 * volume.volume / report.volumes.box, 3), " %)");
        }
        console.say(volumes);
    }
}

Json bake_json(const BakeArguments& arguments, const Imported& imported, const BakeReport& report, const Blob& blob,
               std::span<const Warning> warnings) {
    Json document = json_document();
    document["output"] = arguments.output;
    Json inputs = Json::array();
    for (const ImportedFile& file : imported.files) {
        inputs.push_back({{"file", file.path},
                          {"format", file.format},
                          {"meshes", file.meshes},
                          {"triangles", file.triangles},
                          {"points_and_lines", file.points_and_lines},
                          {"metres_per_unit", file.metres_per_unit},
                          {"unit_origin", file.unit_origin}});
    }
    document["inputs"] = std::move(inputs);
    document["scale"] = arguments.source.scale;
    document["up"] = arguments.source.up ? Json(axis_name(*arguments.source.up)) : Json(nullptr);
    document["source_triangles"] = report.source_triangles;
    document["source_vertices"] = report.source_vertices;
    document["triangles"] = report.triangles;
    document["vertices"] = report.vertices;
    Json findings = Json::object();
    for (const NamedFinding& found : findings_of(report)) {
        findings[found.key] = {{"count", found.finding.count},
                               {"first", found.finding.count == 0 ? Json(nullptr) : Json(found.finding.first)}};
    }
    document["findings"] = std::move(findings);
    document["bounds"] = {{"min", json_point(report.bounds_min)}, {"max", json_point(report.bounds_max)}};
    Json volumes = Json::object();
    if (report.volumes.box > 0.0) volumes["box"] = report.volumes.box;
    for (const NamedVolume& volume : volumes_of(report)) volumes[volume.key] = volume.volume;
    document["volumes"] = std::move(volumes);
    document["extent"] = report.extent;
    document["bits"] = report.bits;
    document["step"] = report.step;
    document["max_error"] = report.max_error;
    document["step_below_float_spacing"] = report.step_below_float_spacing;
    document["bytes"] = report.bytes;
    document["bytes_per_triangle"] = bytes_per_triangle(report);
    document["nodes"] = report.nodes;
    document["leaves"] = report.leaves;
    document["depth"] = report.depth;
    document["closed"] = report.closed;
    document["lost_closed"] = report.lost_closed;
    document["bits_that_keep_closed"] =
        report.bits_that_keep_closed == 0 ? Json(nullptr) : Json(report.bits_that_keep_closed);
    document["rays_rounded_coarsely"] = report.rays_rounded_coarsely;
    document["profile"] = name_of(blob.profile());
    document["checksum"] = checksum_text(blob.checksum());
    document["warnings"] = warnings_json(warnings);
    return document;
}

}  // namespace espalier::tools
