// verify: is this blob or scene sound, and is it the source it was baked from?
#include <iostream>
#include <optional>
#include <span>
#include <vector>

#include <espalier/espalier.hpp>

#include <espalier/bake.hpp>

#include "bake/policy.hpp"
#include "bake/baking.hpp"
#include "base/numbers.hpp"
#include "commands.hpp"
#include "files/blob_file.hpp"
#include "import/files.hpp"
#include "report/diagnostics.hpp"
#include "report/json.hpp"
#include "source_check.hpp"

namespace espalier::tools {

namespace {

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
    return text(counted(file.scene().instance_count(), "instance"), " of ", meshes, meshes == 1 ? " mesh" : " meshes",
                tiles == 0 ? "" : text(" and ", counted(tiles, "tile")));
}

std::string source_failure(const AssetFile& file, const SourceCheck& check) {
    if (file.is_empty() && check.triangles_with_area > 0) {
        return text("the ", file.is_a_scene ? "scene" : "blob", " is empty, but the source has ",
                    counted(check.triangles_with_area, "triangle"), " with area. Is it this source?");
    }
    if (check.too_far == 0) return {};
    return text(check.too_far, " of ", counted(check.checked, "source vertex"),
                " lie farther from the baked surface than its max error ", shortest(max_error_of(file)),
                "; the farthest, at ", rounded(check.worst_distance), ": ", check.worst,
                ". Is it this source, with the --unit, --scale and --up that it was baked with?");
}

Json verification_json(const VerifyArguments& arguments, const Verification& result,
                       std::span<const Warning> warnings) {
    Json document = json_document();
    document["file"] = arguments.blob;
    document["ok"] = result.failure.empty();
    document["status"] = static_cast<int>(result.status);
    document["status_text"] = describe(result.status);
    document["deep"] = result.deep;
    if (result.source) {
        const SourceCheck& check = *result.source;
        document["source"] = {{"vertices", check.vertices}, {"checked", check.checked},
                              {"too_far", check.too_far},   {"worst_distance", check.worst_distance},
                              {"worst", check.worst},       {"measuring_error", check.measuring_error}};
    }
    document["warnings"] = warnings_json(warnings);
    document["failure"] = result.failure.empty() ? Json() : Json(result.failure);
    return document;
}

void print_result(const VerifyArguments& arguments, const AssetFile& file, const Verification& result) {
    std::cout << printable(arguments.blob) << ": ok, " << content_of(file) << '\n';
    std::cout << "  opened: every query on it is safe\n";
    if (result.deep) std::cout << "  deep: every box contains what is below it, and the header's counts are true\n";
    if (result.source) {
        std::cout << "  source: " << counted(result.source->checked, "vertex") << " of " << result.source->vertices
                  << " within max error " << shortest(max_error_of(file)) << ", farthest "
                  << rounded(result.source->worst_distance) << " (measured to "
                  << rounded(result.source->measuring_error, 2) << ")\n";
    }
    finish_standard_output();
}

}  // namespace

ExitCode run_verify(const VerifyArguments& arguments, std::vector<Warning>& warnings) {
    ImportOptions options = import_options(arguments.source, arguments.json, warnings);
    Verification result;
    const AssetFile file(arguments.blob);
    result.status = file.status();
    ExitCode code = exit_code_of(result.status);
    if (result.status != OpenStatus::ok) result.failure = refusal_text(arguments.blob, result.status);
    if (result.failure.empty() && arguments.deep) {
        result.deep = true;
        const VerifyReport report = file.is_a_scene ? verify_scene(file.bytes) : verify(file.bytes);
        if (!report) result.failure = text("'", printable(arguments.blob), "': ", report.message, ". Bake it again.");
    }
    if (result.failure.empty() && !arguments.sources.empty()) {
        options.keep_places = file.is_a_scene;
        const Imported source = import_files(arguments.sources, options);
        if (!arguments.source.allow_empty) refuse_empty_files(source);
        if (arguments.source.strict) refuse_warnings(warnings, source);
        result.source = file.is_a_scene ? check_source(file.scene(), source) : check_source(file.blob, source);
        const std::string failure = source_failure(file, *result.source);
        if (!failure.empty()) result.failure = text("'", printable(arguments.blob), "': ", failure);
    }
    if (!result.failure.empty() && code == ExitCode::ok) code = ExitCode::invalid_input;
    Json document = arguments.json ? verification_json(arguments, result, warnings) : Json();
    if (!result.failure.empty()) {
        return report_failure({code, result.failure, {.file = arguments.blob}}, arguments.json ? &document : nullptr);
    }
    if (arguments.json) {
        print_json(document);
    } else {
        print_result(arguments, file, result);
    }
    return ExitCode::ok;
}

}  // namespace espalier::tools
