// verify: is this blob or scene sound, and is it the source it was baked from?
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <espalier/espalier.hpp>
#include <espalier/import.hpp>
#include <espalier/scenes/bake.hpp>

#include <import/base/numbers.hpp>

#include "bake/baking.hpp"
#include "bake/policy.hpp"
#include "commands.hpp"
#include "files/blob_file.hpp"
#include "report/diagnostics.hpp"
#include "report/json.hpp"
#include "verify/triangles.hpp"
#include "verify/vertices.hpp"

namespace espalier::tools {

namespace {

/// A source, compared with the blob or the scene that was baked from it: promise P3 on the file itself.
struct SourceCheck {
    VertexCheck vertices;
    TriangleCheck triangles;
};

SourceCheck check_source(const AssetFile& file, const ImportResult& source) {
    const std::unique_ptr<StoredTriangles> stored =
        file.is_a_scene ? triangles_of_scene(file.scene()) : triangles_of_blob(file.blob);
    SourceCheck check;
    check.triangles = check_triangles(*stored, source);
    if (file.is_empty()) return check;  // there is no surface to measure from
    check.vertices = file.is_a_scene ? check_vertices(file.scene(), source) : check_vertices(file.blob, source);
    return check;
}

/// The checks that were chosen and their results; `failure` is empty as long as all pass.
struct Verification {
    OpenStatus status = OpenStatus::ok;
    bool deep = false;
    std::optional<SourceCheck> source;
    std::string failure;
};

float max_error_of(const AssetFile& file) { return file.is_a_scene ? file.scene().max_error() : file.blob.max_error(); }

std::string content_of(const AssetFile& file) {
    if (!file.is_a_scene) return counted(file.blob.triangle_count(), "triangle");
    const std::size_t meshes = file.scene().meshes().size(), tiles = file.scene().tiles().size();
    return text(counted(file.scene().instance_count(), "instance"), " of ", counted(meshes, "mesh"),
                tiles == 0 ? "" : text(" and ", counted(tiles, "tile")));
}

const char* what_is(const AssetFile& file) { return file.is_a_scene ? "scene" : "blob"; }

/// Returns how the triangles of the source and those that are stored differ; nothing if they do not.
std::string triangle_difference(const AssetFile& file, const TriangleCheck& check) {
    std::string words;
    if (check.missing != 0) {
        words = text(check.missing, " of ", counted(check.checked, "triangle"), " of the source ",
                     check.missing == 1 ? "is" : "are", " not in the ", what_is(file),
                     ", the first: ", check.first_missing);
    }
    if (check.sourceless.count != 0) {
        words += text(words.empty() ? "" : "; ", check.sourceless.count, " of ", counted(check.stored, "triangle"),
                      " of the ", what_is(file), check.sourceless.count == 1 ? " is" : " are",
                      " not in the source, the first: ", check.sourceless.first);
    }
    return words;
}

/// Returns the error that the comparison is; nothing if they are the same surface.
std::optional<CommandError> source_failure(const AssetFile& file, const ImportResult& source,
                                           const SourceCheck& check) {
    const VertexCheck& vertices = check.vertices;
    const TriangleCheck& triangles = check.triangles;
    ErrorDetails details{.file = file.path};
    std::string problem;
    // Which of its triangles a lattice flattens is unknown of an empty blob: its step is no bake's.
    const std::uint64_t with_area = triangles.missing + triangles.dropped.collapsed.count;
    if (file.is_empty() && with_area != 0) {
        problem =
            text("the ", what_is(file), " is empty, but the source has ", counted(with_area, "triangle"), " with area");
    } else if (vertices.too_far != 0) {
        problem = text(vertices.too_far, " of ", counted(vertices.checked, "source vertex"),
                       " lie farther from the baked surface than its max error ", shortest(max_error_of(file)),
                       "; the farthest, at ", rounded(vertices.worst_distance), ": ", vertices.worst);
    } else {
        problem = triangle_difference(file, triangles);
        if (triangles.first_missing_at) details = details_of(*triangles.first_missing_at, source);
    }
    if (problem.empty()) return std::nullopt;
    return CommandError(ExitCode::invalid_input,
                        text("'", printable(file.path), "': ", problem,
                             ". Is it this source, with the --unit, --scale and --up that it was baked with?"),
                        std::move(details));
}

Json dropped_json(const Findings& dropped) {
    Json counts = Json::object();
    for (const DropReason& reason : drop_reasons) counts[reason.key] = (dropped.*reason.finding).count;
    return counts;
}

Json source_json(const SourceCheck& check) {
    const VertexCheck& vertices = check.vertices;
    const TriangleCheck& triangles = check.triangles;
    const bool is_whole = triangles.checked == triangles.triangles;
    return {{"vertices", vertices.vertices},
            {"checked", vertices.checked},
            {"too_far", vertices.too_far},
            {"worst_distance", vertices.worst_distance},
            {"worst", vertices.worst},
            {"measuring_error", vertices.measuring_error},
            {"triangles", triangles.triangles},
            {"triangles_checked", triangles.checked},
            {"triangles_missing", triangles.missing},
            {"triangles_dropped", dropped_json(triangles.dropped)},
            {"triangles_without_source", is_whole ? Json(triangles.sourceless.count) : Json(nullptr)}};
}

Json verification_json(const VerifyArguments& arguments, const Verification& result,
                       std::span<const Warning> warnings) {
    Json document = json_document();
    document["file"] = arguments.blob;
    document["ok"] = result.failure.empty();
    document["status"] = static_cast<int>(result.status);
    document["status_text"] = describe(result.status);
    document["deep"] = result.deep;
    if (result.source) document["source"] = source_json(*result.source);
    document["warnings"] = warnings_json(warnings);
    document["failure"] = result.failure.empty() ? Json() : Json(result.failure);
    return document;
}

/// Prints the triangles that were dropped, for each reason.
void print_dropped(const Findings& dropped) {
    for (const DropReason& reason : drop_reasons) {
        const std::uint64_t count = (dropped.*reason.finding).count;
        if (count != 0) std::cout << "  dropped: " << counted(count, "triangle") << ' ' << reason.words << '\n';
    }
}

void print_source(const AssetFile& file, const SourceCheck& check) {
    const VertexCheck& vertices = check.vertices;
    const TriangleCheck& triangles = check.triangles;
    std::cout << "  source: " << counted(vertices.checked, "vertex") << " of " << vertices.vertices
              << " within max error " << shortest(max_error_of(file)) << ", farthest "
              << rounded(vertices.worst_distance) << " (measured to " << rounded(vertices.measuring_error, 2) << ")\n";
    if (triangles.checked == triangles.triangles) {
        std::cout << "  triangles: the source and the " << what_is(file) << " have the same "
                  << counted(triangles.stored, "triangle") << '\n';
    } else {
        std::cout << "  triangles: " << triangles.checked << " of " << triangles.triangles
                  << " were looked up, and all are in the " << what_is(file) << '\n';
    }
    print_dropped(triangles.dropped);
}

void print_result(const VerifyArguments& arguments, const AssetFile& file, const Verification& result) {
    std::cout << printable(arguments.blob) << ": ok, " << content_of(file) << '\n';
    std::cout << "  opened: every query on it is safe\n";
    if (result.deep) std::cout << "  deep: every box contains what is below it, and the header's counts are true\n";
    if (result.source) print_source(file, *result.source);
    finish_standard_output();
}

}  // namespace

ExitCode run_verify(const VerifyArguments& arguments, std::vector<Warning>& warnings) {
    ImportOptions options = import_options(arguments.source, arguments.json, warnings);
    Verification result;
    const AssetFile file(arguments.blob);
    result.status = file.status();
    ExitCode code = exit_code_of(result.status);
    ErrorDetails details{.file = arguments.blob};
    if (result.status != OpenStatus::ok) result.failure = file.refusal();
    if (result.failure.empty() && arguments.deep) {
        result.deep = true;
        const VerifyReport report = file.is_a_scene ? verify_scene(file.bytes) : verify(file.bytes);
        if (!report) result.failure = text("'", printable(arguments.blob), "': ", report.message, ". Bake it again.");
    }
    if (result.failure.empty() && !arguments.sources.empty()) {
        options.keep_places = file.is_a_scene;
        const ImportResult source = import_or_throw(arguments.sources, options);
        if (!arguments.source.allow_empty) refuse_empty_files(source);
        if (arguments.source.strict) refuse_warnings(warnings, source);
        result.source = check_source(file, source);
        if (const auto different = source_failure(file, source, *result.source)) {
            result.failure = different->what();
            details = different->details();
        }
    }
    if (!result.failure.empty() && code == ExitCode::ok) code = ExitCode::invalid_input;
    Json document = arguments.json ? verification_json(arguments, result, warnings) : Json();
    if (!result.failure.empty()) {
        return report_failure({code, result.failure, details}, arguments.json ? &document : nullptr);
    }
    if (arguments.json) {
        print_json(document);
    } else {
        print_result(arguments, file, result);
    }
    return ExitCode::ok;
}

}  // namespace espalier::tools
