// How a verb reports that it failed: one line on stderr, and with --json one document on stdout.
#pragma once

#include <string>

#include "exit_code.hpp"
#include "json_output.hpp"

namespace espalier::tools {

/// Prints the error's message to stderr, and `document` with the key `error` to stdout, if there is one. Returns the
/// exit status.
ExitCode report_failure(const CommandError& error, Json* document);

/// Returns the text of the document of a verb that failed before it had a result.
std::string failure_document(const CommandError& error);

}  // namespace espalier::tools
