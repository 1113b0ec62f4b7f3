#include "baking.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <import/base/numbers.hpp>

#include "bake/policy.hpp"
#include "layout/places.hpp"
#include "report/source_point.hpp"

namespace espalier::tools {

namespace {

constexpr std::size_t most_meshes_listed = 16;

std::string words_for(const SceneMesh& mesh) {
    if (mesh.name.empty()) return text("merged from ", counted(mesh.places, "mesh"));
    return text(mesh.name, ", ", counted(mesh.instances, "instance"));
}

std::string checksum_of(const BakedScene& scene) { return checksum_text(detail::data_of(scene).tree.checksum); }

void add_finding(Finding& sum, const Finding& finding, std::uint64_t times) {
    if (finding.count == 0) return;
    if (sum.count == 0) sum = {0, finding.first, finding.place};
    sum.count += finding.count * times;
}

}  // namespace

void say_scene(const Console& console, const SceneBake& baked, const BakedScene& scene) {
    say_findings(console, baked.total);
    const SceneReport& report = baked.report;
    if (report.instances == 0) {
        console.say(baked.total.source.triangles == 0 ? "the input has no triangles" : "no triangle is left",
                    "; the scene is valid and empty, and every query of it finds nothing");
    }
    std::size_t listed = 0;
    for (const SceneMesh& mesh : baked.meshes) {
        if (mesh.instances == 0) continue;
        if (listed++ == most_meshes_listed) {
            console.say("...; --json lists all of the ", report.meshes, " meshes");
            break;
        }
        const BakeReport& of_mesh = mesh.baked;
        console.say("mesh: ", words_for(mesh), "; ", counted(of_mesh.tree.triangles, "triangle"), ", ",
                    counted(of_mesh.bytes, "byte"), ", ", of_mesh.lattice.bits, " bits, step ",
                    rounded(of_mesh.lattice.step), ", max error ", rounded(of_mesh.lattice.max_error));
    }
    if (report.origin != Vec3d{}) {
        console.say("origin: ", words_for_origin(report.origin),
                    " of the source is 0 0 0 of the scene, from which its coordinates and the bounds count");
    }
    const Box bounds = scene.bounds();
    console.say("bounds: ", shortest(bounds.min), " to ", shortest(bounds.max), " (around boxes of instances)");
    console.say("max error: ", shortest(report.max_error),
                " of the meshes at the places that the scene stores; those differ from the source's by up to ",
                rounded(baked.placing_error), ", and surfaces by ", rounded(baked.max_error), " in all");
    console.say("scene: ", counted(report.instances, "instance"), " of ", counted(report.meshes, "mesh"), ", ",
                counted(report.triangles, "triangle"), ", ", counted(report.nodes, "node"), ", depth ", report.depth);
    if (report.on_common_lattice > 1)
        console.say("common lattice: ", report.on_common_lattice, " of ", counted(report.instances, "instance"),
                    "; where two of them share an edge or a vertex, no ray passes between them");
    console.say("size: ", counted(report.bytes, "byte"), ", of which the meshes take ", report.mesh_bytes);
}

Json scene_json(const BakeArguments& arguments, const ImportResult& imported, const SceneBake& baked,
                const BakedScene& scene, std::span<const Warning> warnings) {
    const SceneReport& report = baked.report;
    Json document = input_json(arguments, imported);
    document["source_triangles"] = baked.total.source.triangles;
    document["source_vertices"] = baked.total.source.vertices;
    document["triangles"] = report.triangles;
    document["findings"] = findings_json(baked.total);
    document["bounds"] = json_box(scene.bounds().min, scene.bounds().max);
    if (report.origin != Vec3d{}) document["source_origin"] = json_point(report.origin);
    document["max_error"] = json_number(report.max_error);
    document["placing_error"] = baked.placing_error;
    document["total_error"] = baked.max_error;
    document["bytes"] = report.bytes;
    document["mesh_bytes"] = report.mesh_bytes;
    document["nodes"] = report.nodes;
    document["depth"] = report.depth;
    document["mesh_count"] = report.meshes;
    document["instance_count"] = report.instances;
    document["on_common_lattice"] = report.on_common_lattice;
    Json meshes = Json::array();
    for (const SceneMesh& mesh : baked.meshes) {
        meshes.push_back({{"name", mesh.name.empty() ? Json(nullptr) : Json(mesh.name)},
                          {"places", mesh.places},
                          {"instances", mesh.instances},
                          {"triangles", mesh.baked.tree.triangles},
                          {"bytes", mesh.baked.bytes},
                          {"bits", mesh.baked.lattice.bits},
                          {"step", mesh.baked.lattice.step},
                          {"max_error", mesh.baked.lattice.max_error},
                          {"closed", mesh.baked.closed}});
    }
    document["meshes"] = std::move(meshes);
    Json sources = Json::array();
    for (const std::optional<std::uint32_t>& number : baked.places) {
        if (!number) {
            sources.push_back(nullptr);
            continue;
        }
        const ImportedPlace& place = imported.places[*number];
        sources.push_back({{"file", place.file}, {"mesh", place.number}});
    }
    document["sources"] = std::move(sources);
    document["checksum"] = checksum_of(scene);
    document["warnings"] = warnings_json(warnings);
    return document;
}

void ReportTotal::add(const BakeReport& report, const std::string& name, std::uint64_t instances) {
    sum_.source.triangles += report.source.triangles * instances;
    sum_.source.vertices += report.source.vertices * instances;
    for (const DropReason& reason : drop_reasons)
        add_finding(sum_.findings.*reason.finding, report.findings.*reason.finding, instances);
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    sum_.tree.triangles =
        static_cast<std::uint32_t>(std::min(most, sum_.tree.triangles + report.tree.triangles * instances));
    sum_.seconds += report.seconds;
    for (const BakeWarning& warning : report.warnings) {
        const auto known = std::find_if(warnings_.begin(), warnings_.end(), [&warning](const CountedWarning& counted) {
            return counted.first.kind == warning.kind;
        });
        if (known != warnings_.end()) {
            ++known->meshes;
        } else {
            const std::string place = name.empty() ? "the merged mesh" : name;
            warnings_.push_back({{warning.kind, text(place, ": ", warning.message)}, 1});
        }
    }
}

BakeReport ReportTotal::report() const {
    BakeReport total = sum_;
    for (const CountedWarning& warning : warnings_) {
        total.warnings.push_back(warning.first);
        if (warning.meshes > 1)
            total.warnings.back().message += text(" The scene has ", warning.meshes, " such meshes.");
    }
    return total;
}

}  // namespace espalier::tools
