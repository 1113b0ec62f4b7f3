#include "failure.hpp"

#include <iostream>

#include "warnings.hpp"

namespace espalier::tools {

ExitCode report_failure(const CommandError& error, Json* document) {
    const ErrorDetails& details = error.details();
    std::cerr << "espalier: " << error.what() << '\n';
    if (document != nullptr) {
        if (!details.warnings.empty()) (*document)["warnings"] = warnings_json(details.warnings);
        (*document)["error"] =
            diagnostic_json({details.kind, error.what(), details.file, details.mesh, details.triangle});
        print_json(*document);
    }
    return error.code();
}

}  // namespace espalier::tools
