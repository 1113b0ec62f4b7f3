#include "source_options.hpp"

#include <cmath>
#include <iostream>
#include <utility>

#include "base/lengths.hpp"
#include "base/numbers.hpp"
#include "import/files.hpp"
#include "import/guards/limit_guard.hpp"
#include "report/console.hpp"
#include "report/diagnostics.hpp"

namespace espalier::tools {

namespace {

constexpr std::uint64_t least_import_memory = 1 << 20;

std::uint64_t import_memory(const std::string& input) {
    if (input.empty()) return default_import_memory();
    if (input == "none") return 0;
    const std::uint64_t bytes = parse_byte_size(input, "--import-memory");
    if (bytes >= least_import_memory) return bytes;
    throw CommandError(ExitCode::usage, text("--import-memory: '", printable(input), "' is ", counted(bytes, "byte"),
                                             ", too few to read any file. Write 1M or more, such as 512M or 4G."));
}

}  // namespace

ImportOptions import_options(const SourceArguments& arguments, bool json, std::vector<Warning>& warnings) {
    ImportOptions options;
    if (!std::isfinite(arguments.scale) || arguments.scale <= 0.0) {
        throw CommandError(ExitCode::usage,
                           text("--scale ", arguments.scale, ": a scale is a finite number above zero."));
    }
    options.scale = arguments.scale;
    if (!arguments.unit.empty()) {
        options.metres_per_unit = metres_in(arguments.unit);
        if (!options.metres_per_unit) {
            throw CommandError(ExitCode::usage, text("--unit '", printable(arguments.unit),
                                                     "': the units are um, mm, cm, m, km, in and ft."));
        }
    }
    options.up = arguments.up;
    options.limits.memory = import_memory(arguments.import_memory);
    options.limits.seconds = arguments.import_seconds;
    if (arguments.verbose) options.log = [](const std::string& line) { std::cerr << "importer: " << line << '\n'; };
    options.warn = [&warnings](const Warning& warning) { give({&warning, 1}, warnings); };
    if (json) {
        options.failure_document = [&warnings](const CommandError& error) { return failure_document(error, warnings); };
    }
    return options;
}

Imported import_with_progress(std::span<const std::string> paths, ImportOptions options, bool quiet) {
    Progress progress(quiet);
    options.progress = [&progress](const char* stage, double done) { progress.show(stage, done); };
    options.warn = [&progress, warn = std::move(options.warn)](const Warning& warning) {
        progress.hide();
        warn(warning);
    };
    return import_files(paths, options);
}

}  // namespace espalier::tools
