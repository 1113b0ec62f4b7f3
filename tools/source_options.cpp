#include "source_options.hpp"

#include <cmath>

#include "lengths.hpp"
#include "numbers.hpp"

namespace espalier::tools {

ImportOptions import_options(const SourceArguments& arguments) {
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
    return options;
}

}  // namespace espalier::tools
