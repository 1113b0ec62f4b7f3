// verify: is this blob sound, and is it the mesh it was baked from?
#include <iostream>
#include <optional>
#include <span>
#include <vector>

#include <espalier/espalier.hpp>

#include <espalier/bake.hpp>

#include "bake/policy.hpp"
#include "bake/source_options.hpp"
#include "base/numbers.hpp"
#include "commands.hpp"
#include "files/blob_file.hpp"
#include "import/files.hpp"
#include "report/console.hpp"
#include "report/diagnostics.hpp"
#include "report/failure.hpp"
#include "report/json_output.hpp"
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

std::string source_failure(const Blob& blob, const SourceCheck& check) {
    if (blob.triangle_count() == 0 && check.triangles_with_area > 0) {
        return text("the blob is empty, but the source has ", counted(check.triangles_with_area, "triangle"),
                    " with area. Is it this source?");
    }
    if (check.too_far == 0) return {};
    return text(check.too_far, " of ", counted(check.checked, "source vertex"),
                " lie farther from the baked surface than its max error ", shortest(blob.max_error()),
                "; the farthest, at ", rounded(check.worst_distance), ": ", check.worst,
                ". Is it this source, with the --unit, --scale and --up that it was baked with?");
}

Json result_json(const VerifyArguments& arguments, const Verification& result, std::span<const Warning> warnings) {
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

void print_result(const VerifyArguments& arguments, const BlobFile& file, const Verification& result) {
    std::cout << printable(arguments.blob) << ": ok, " << counted(file.blob.triangle_count(), "triangle") << '\n';
    std::cout << "  opened: every query on it is safe\n";
    if (result.deep) std::cout << "  deep: every box contains what is below it, and the header's counts are true\n";
    if (result.source) {
        std::cout << "  source: " << counted(result.source->checked, "vertex") << " of " << result.source->vertices
                  << " within max error " << shortest(file.blob.max_error()) << ", farthest "
                  << rounded(result.source->worst_distance) << " (measured to "
                  << rounded(result.source->measuring_error, 2) << ")\n";
    }
    finish_standard_output();
}

ExitCode verify_with_warnings(const VerifyArguments& arguments, std::vector<Warning>& warnings) {
    const ImportOptions options = import_options(arguments.source, arguments.json, warnings);
    Verification result;
    BlobFile file;
    file.bytes = read_file(arguments.blob);
    file.blob = open(file.bytes);
    result.status = file.blob.status();
    ExitCode code = exit_code_of(result.status);
    if (result.status != OpenStatus::ok) result.failure = refusal_text(arguments.blob, result.status);
    if (result.failure.empty() && arguments.deep) {
        result.deep = true;
        const VerifyReport report = verify(file.bytes);
        if (!report) result.failure = text("'", printable(arguments.blob), "': ", report.message, ". Bake it again.");
    }
    if (result.failure.empty() && !arguments.sources.empty()) {
        const Imported source = import_files(arguments.sources, options);
        if (!arguments.source.allow_empty) refuse_empty_files(source);
        if (arguments.source.strict) refuse_warnings(warnings, source);
        result.source = check_source(file.blob, source);
        const std::string failure = source_failure(file.blob, *result.source);
        if (!failure.empty()) result.failure = text("'", printable(arguments.blob), "': ", failure);
    }
    if (!result.failure.empty() && code == ExitCode::ok) code = ExitCode::invalid_input;
    Json document = arguments.json ? result_json(arguments, result, warnings) : Json();
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

}  // namespace

ExitCode run_verify(const VerifyArguments& arguments) {
    return with_warnings([&](std::vector<Warning>& warnings) { return verify_with_warnings(arguments, warnings); });
}

}  // namespace espalier::tools
