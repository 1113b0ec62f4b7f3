#include "failure.hpp"

#include <exception>
#include <iostream>
#include <new>
#include <utility>

#include "base/numbers.hpp"
#include "diagnostics.hpp"

namespace espalier::tools {

namespace {

void put_error(const CommandError& error, Json& document) {
    const ErrorDetails& details = error.details();
    document["error"] = diagnostic_json({details.kind, error.what(), details.file, details.mesh, details.triangle});
}

CommandError with(const CommandError& error, const std::vector<Warning>& warnings) {
    ErrorDetails details = error.details();
    details.warnings = warnings;
    return {error.code(), error.what(), std::move(details)};
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

std::string failure_document(const CommandError& error, const std::vector<Warning>& warnings) {
    Json document = json_document();
    document["warnings"] = warnings_json(warnings);
    put_error(error, document);
    return json_text(document);
}

CommandError current_failure() {
    try {
        throw;
    } catch (const CommandError& error) {
        return error;
    } catch (const std::bad_alloc&) {
        return {ExitCode::internal, "the machine has not enough memory for this. Bake the asset in parts."};
    } catch (const std::exception& error) {
        return {ExitCode::internal, text("internal error: ", error.what(), ". Please report how it came about.")};
    }
}

ExitCode with_warnings(const std::function<ExitCode(std::vector<Warning>&)>& verb) {
    std::vector<Warning> warnings;
    try {
        return verb(warnings);
    } catch (...) {
        throw with(current_failure(), warnings);
    }
}

}  // namespace espalier::tools
