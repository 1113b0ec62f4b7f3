#include "baking.hpp"

#include <cmath>
#include <iostream>
#include <optional>
#include <string_view>
#include <utility>

#include <baker/bake_with.hpp>
#include <baker/quantise/lattice.hpp>
#include <espalier/import.hpp>

#include "base/choices.hpp"
#include "policy.hpp"
#include "report/diagnostics.hpp"

namespace espalier::tools {

namespace {

constexpr std::uint64_t least_import_memory = 1 << 20;

std::uint64_t import_memory(const std::string& input) {
    if (input.empty()) {
        if (const std::optional<std::uint64_t> bytes = default_import_memory()) return *bytes;
        throw_error(ExitCode::unsupported,
                    "--import-memory: the system does not report how much memory the machine has, of which half is the "
                    "limit without this option. Give an amount such as 4G, or none.");
    }
    if (input == "none") return 0;
    const std::uint64_t bytes = parse_byte_size(input, "--import-memory");
    if (bytes >= least_import_memory) return bytes;
    throw_error(ExitCode::usage, "--import-memory: '", printable(input), "' is ", counted(bytes, "byte"),
                ", too few to read any file. Write 1M or more, such as 512M or 4G.");
}

ExitCode exit_code_of_bake(BakeStatus status) {
    // too_fine: the mesh is sound and the option is well-formed, and together they need more than 24 bits.
    constexpr ExitCode codes[] = {ExitCode::ok,          ExitCode::usage,       ExitCode::invalid_input,
                                  ExitCode::unsupported, ExitCode::unsupported, ExitCode::internal};
    return codes[static_cast<std::size_t>(status)];
}

ExitCode exit_code_of_import(ImportStatus status) {
    constexpr ExitCode codes[] = {ExitCode::ok,          ExitCode::usage,
                                  ExitCode::file_access, ExitCode::invalid_input,
                                  ExitCode::unsupported, ExitCode::internal};
    return codes[static_cast<std::size_t>(status)];
}

CommandError command_error(ExitCode code, const ImportDiagnostic& reason) {
    return {code,
            reason.message,
            {.file = reason.file, .mesh = reason.mesh, .triangle = reason.triangle, .kind = reason.kind}};
}

/// A remedy at the end of a message of the library, which names its options, and the same in options of the command.
struct Remedy {
    std::string_view in_library;
    std::string_view in_command;
};
constexpr Remedy remedies[] = {
    {"drop them with drop_bad_triangles", "drop them with --drop-bad-triangles, which counts them"},
    {"scale the input", "scale the input with --scale, or state its unit with --unit"},
};

std::string in_words_of_command(std::string message) {
    constexpr std::string_view flat_angle = "flat_angle, ";  // the only option whose range the command leaves to bake()
    if (message.starts_with(flat_angle)) message.replace(0, flat_angle.size(), "--flat-angle, ");
    for (const Remedy& remedy : remedies) {
        if (!message.ends_with(remedy.in_library)) continue;
        message.resize(message.size() - remedy.in_library.size());
        message += remedy.in_command;
    }
    return message;
}

/// Returns what a bake was refused for. A reason that names no mesh is one of all the files.
CommandError refusal_of_bake(const BakeResult& result, const ImportResult& imported) {
    const ExitCode code = exit_code_of_bake(result.status);
    std::string message = in_words_of_command(result.message);
    if (!message.ends_with('.')) message += '.';
    if (result.place) return {code, message, details_of(*result.place, imported)};
    if (code != ExitCode::unsupported) return {code, message};
    return {code, text(names_of_inputs(imported), ": ", message), {.file = only_input(imported)}};
}

BakeResult sound_or_throw(BakeResult result, const ImportResult& imported) {
    if (!result) throw refusal_of_bake(result, imported);
    static_cast<void>(opened(result));
    return result;
}

}  // namespace

ImportOptions import_options(const SourceArguments& arguments, bool json, std::vector<Warning>& warnings) {
    ImportOptions options;
    if (!std::isfinite(arguments.scale) || arguments.scale <= 0.0) {
        throw_error(ExitCode::usage, "--scale ", arguments.scale, ": a scale is a finite number above zero.");
    }
    options.scale = arguments.scale;
    options.format = lower_case(arguments.format);
    if (!arguments.unit.empty()) {
        options.metres_per_unit = metres_in(arguments.unit);
        if (!options.metres_per_unit) {
            throw_error(ExitCode::usage, "--unit '", printable(arguments.unit),
                        "': the units are um, mm, cm, m, km, in and ft.");
        }
    }
    options.up = arguments.up;
    options.limits.memory = import_memory(arguments.import_memory);
    options.limits.seconds = arguments.import_seconds;
    if (arguments.verbose) options.log = [](const std::string& line) { std::cerr << "importer: " << line << '\n'; };
    options.warn = [&warnings](const Warning& warning) { give({&warning, 1}, warnings); };
    options.last_words = [json, &warnings](const ImportDiagnostic& reason) {
        const CommandError error = command_error(ExitCode::invalid_input, reason);
        return LastWords{static_cast<int>(error.code()), text("espalier: ", error.what(), '\n'),
                         json ? failure_document(error, warnings) : std::string()};
    };
    return options;
}

ImportResult import_or_throw(std::span<const std::string> paths, const ImportOptions& options) {
    ImportResult imported = import_meshes(paths, options);
    if (!imported) throw command_error(exit_code_of_import(imported.status), imported.reason);
    return imported;
}

ImportResult import_with_progress(std::span<const std::string> paths, ImportOptions options, bool quiet) {
    Progress progress(quiet);
    options.progress = [&progress](const char* stage, double done) { progress.show(stage, done); };
    options.warn = [&progress, warn = std::move(options.warn)](const Warning& warning) {
        progress.hide();
        warn(warning);
    };
    return import_or_throw(paths, options);
}

Vec3d origin_of(const ImportResult& imported, const BakeOptions& options) {
    return baker::choose_origin(imported.views(), options);
}

ErrorDetails details_of(const SourcePlace& place, const ImportResult& imported) {
    ErrorDetails details;
    details.file = imported.files.at(place.file).path;
    details.mesh = place.mesh;
    details.triangle = place.triangle;
    return details;
}

BakeResult bake_or_throw(const ImportResult& imported, const BakeOptions& options) {
    return bake_or_throw(imported.views(), imported, options);
}

BakeResult bake_or_throw(std::span<const MeshView> meshes, const ImportResult& imported, const BakeOptions& options) {
    return sound_or_throw(bake(meshes, options), imported);
}

BakeResult bake_trial_or_throw(const ImportResult& imported, const BakeOptions& options) {
    return sound_or_throw(baker::bake_trial(imported.views(), options), imported);
}

Blob opened(const BakeResult& baked) {
    const Blob blob = open(baked.bytes);
    if (!blob) {
        throw_error(ExitCode::internal,
                    "the baked blob is refused by this program's own reader: ", describe(blob.status()),
                    ". Nothing was written; please report the mesh.");
    }
    return blob;
}

}  // namespace espalier::tools
