#include "source_options.hpp"

#include <cmath>
#include <iostream>
#include <string>

#include "byte_sizes.hpp"
#include "failure.hpp"
#include "import/limit_guard.hpp"
#include "lengths.hpp"
#include "numbers.hpp"

namespace espalier::tools {

ImportOptions import_options(const SourceArguments& arguments, bool json) {
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
    options.limits.memory = arguments.import_memory.empty()
                                ? default_import_memory()
                                : parse_byte_size(arguments.import_memory, "--import-memory");
    options.limits.seconds = arguments.import_seconds;
    if (arguments.verbose) options.log = [](const std::string& line) { std::cerr << "importer: " << line << '\n'; };
    if (json) options.failure_document = failure_document;
    return options;
}

}  // namespace espalier::tools
