// How a verb reports that it failed: one line on stderr, and with --json one document on stdout.
#pragma once

#include "exit_code.hpp"
#include "json_output.hpp"

namespace espalier::tools {

/// Prints the error's message to stderr, and `document` with the key `error` to stdout, if there is one. Returns the
/// exit status.
ExitCode report_failure(const CommandError& error, Json* document);

}  // namespace espalier::tools
