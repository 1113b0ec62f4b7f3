#include "failure.hpp"

#include <iostream>

#include "warnings.hpp"

namespace espalier::tools {

namespace {

void put_error(const CommandError& error, Json& document) {
    const ErrorDetails& details = error.details();
    if (!details.warnings.empty()) document["warnings"] = warnings_json(details.warnings);
    document["error"] = diagnostic_json({details.kind, error.what(), details.file, details.mesh, details.triangle});
}

}  // namespace

ExitCode report_failure(const CommandError& error, Json* document) {
    std::cerr << "espalier: " << error.what() << '\n';
    if (document != nullptr) {
        put_error(error, *document);
        print_json(*document);
    }
    return error.code();
}

std::string failure_document(const CommandError& error) {
    Json document = json_document();
    put_error(error, document);
    return json_text(document);
}

}  // namespace espalier::tools
