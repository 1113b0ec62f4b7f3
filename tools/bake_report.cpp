#include "bake_report.hpp"

#include "blob_layout.hpp"
#include "numbers.hpp"

namespace espalier::tools {

namespace {

constexpr double largest_expected_extent = 1000.0;  // metres
constexpr double smallest_expected_extent = 0.001;

const char* axis_name(Axis axis) { return axis == Axis::x ? "+X" : axis == Axis::y ? "+Y" : "+Z"; }

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

/// Why the baked surface is not closed, though the source is, and what keeps it closed.
std::string lost_closed_text(const BakeReport& report) {
    std::string dropped, advice;
    const auto add = [&](const Finding& finding, const char* what, const char* remedy) {
        if (finding.count == 0) return;
        dropped += text(dropped.empty() ? "" : " and ", counted(finding.count, "triangle"), ' ', what,
                        " (first: ", finding.first, ")");
        advice += text(advice.empty() ? ": " : "; ", remedy);
    };
    if (report.triangles != 0) {
        add(report.duplicate, "with the corners of another one", "bake parts that share triangles into separate blobs");
        add(report.zero_area, "without area", "split the long edge beside a triangle without area, and remove that one");
    }
    const std::string reason = dropped.empty() ? "no triangle is left" : "it lacks " + dropped;
    if (advice.empty()) advice = ": it is too thin for its length";
    const std::string keeping = report.bits_that_keep_closed == 0
                                    ? "No number of bits keeps it closed" + advice
                                    : text("--bits ", report.bits_that_keep_closed, " keeps it closed");
    return text("the source is closed, but at ", counted(report.bits, "bit"), " the baked surface is not, because ",
                reason, ": inside and signed-distance queries will refuse it. ", keeping, ".");
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
        if (file.stated_up && !arguments.source.up) {
            const std::string axis = axis_name(*file.stated_up);
            console.warn(text(printable(file.path), " states that ", axis, " is up, and its axes were kept; --up ",
                              axis == "+X" ? "x" : "z", " turns ", axis, " to +Y."));
        }
    }
    console.say(arguments.source.up ? text("axes: ", axis_name(*arguments.source.up), " of the input is +Y in the blob")
                                    : std::string("axes: as imported (--up turns another axis to +Y)"));
}

void say_findings(const Console& console, const BakeReport& report) {
    for (const NamedFinding& found : findings_of(report)) {
        if (found.finding.count == 0) continue;
        console.say(text("dropped ", counted(found.finding.count, "triangle"), ' ', found.what,
                         "; first: ", found.finding.first));
    }
    if (report.source_triangles == 0) {
        console.warn("the input has no triangles; the blob is valid and empty, and every query of it finds nothing.");
    } else if (report.triangles == 0) {
        console.warn("no triangle is left; the blob is valid and empty, and every query of it finds nothing.");
    }
}

void say_result(const Console& console, const BakeReport& report) {
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
    if (report.step_below_float_spacing) {
        console.warn(
            text("the lattice step ", rounded(report.step),
                 " is finer than the spacing of the source's own floats at its coordinates: fewer bits or a "
                 "coarser tolerance loses nothing, and moving the asset closer to the origin gains accuracy."));
    }
    if (report.lost_closed) console.warn(lost_closed_text(report));
    if (report.triangles == 0) return;
    if (report.rays_rounded_coarsely) {
        console.warn(
            text("at ", counted(report.bits, "bit"),
                 " rays that start outside of the asset are rounded to whole lattice steps, coarser than "
                 "float32: one that is aimed exactly at a corner may miss it. 22 bits or fewer leave room for a "
                 "finer grid."));
    }
    if (report.extent > largest_expected_extent || report.extent < smallest_expected_extent) {
        console.warn(text("the asset is ", rounded(report.extent),
                          " m across. If that is not what it is, give the unit of its file with --unit, or --scale."));
    }
}

Json bake_json(const BakeArguments& arguments, const Imported& imported, const BakeReport& report, const Blob& blob) {
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
    return document;
}

}  // namespace espalier::tools
