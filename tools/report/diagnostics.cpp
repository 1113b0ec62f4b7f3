#include "diagnostics.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <optional>
#include <utility>

#include <import/platform/process.hpp>

namespace espalier::tools {

namespace {

template <class Value>
Json or_null(const std::optional<Value>& value) {
    return value ? Json(*value) : Json(nullptr);
}

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

void Console::print(const std::string& line) { std::cerr << line << '\n'; }

void Console::warn(const Warning& warning) { std::cerr << "warning: " << warning.message << '\n'; }

Progress::Progress(bool quiet)
    : enabled_(!quiet && is_stderr_terminal()), next_(Clock::now() + std::chrono::seconds(1)) {}

Progress::~Progress() { hide(); }

void Progress::hide() {
    if (shown_) std::cerr << "\r\x1b[K" << std::flush;
    shown_ = false;
}

void Progress::show(const char* stage, double done) {
    if (!enabled_) return;
    const auto now = Clock::now();
    if (now < next_) return;
    next_ = now + std::chrono::milliseconds(100);
    shown_ = true;
    const int percent = static_cast<int>(100.0 * std::clamp(done, 0.0, 1.0));
    std::cerr << "\r\x1b[K" << percent << " % " << stage << std::flush;
}

void finish_standard_output() {
    std::cout.flush();
    if (!std::cout || std::fflush(stdout) != 0) {
        throw_error(ExitCode::file_access, "standard output cannot be written; is the disk full, or the reader gone?");
    }
}

void print_json(const Json& document) {
    std::cout << json_text(document);
    finish_standard_output();
}

void give(std::span<const Warning> found, std::vector<Warning>& warnings) {
    for (const Warning& warning : found) Console::warn(warning);
    warnings.insert(warnings.end(), found.begin(), found.end());
}

Json diagnostic_json(const Warning& warning) {
    return {{"kind", warning.kind},
            {"message", warning.message},
            {"file", warning.file.empty() ? Json(nullptr) : Json(warning.file)},
            {"mesh", or_null(warning.mesh)},
            {"triangle", or_null(warning.triangle)}};
}

Json warnings_json(std::span<const Warning> warnings) {
    Json list = Json::array();
    for (const Warning& warning : warnings) list.push_back(diagnostic_json(warning));
    return list;
}

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
