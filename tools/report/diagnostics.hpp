// Warnings and errors, for people and for scripts: a failed verb prints one line on stderr, and with --json one
// document on stdout.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/exit_code.hpp"
#include "json_output.hpp"

namespace espalier::tools {

/// Prints warnings and adds them to the list.
void give(std::span<const Warning> found, std::vector<Warning>& warnings);

/// Returns an object with kind, message, file, mesh and triangle; what is unknown is null. Errors have the same keys.
Json diagnostic_json(const Warning& warning);
Json warnings_json(std::span<const Warning> warnings);

/// Prints the error's message to stderr, and `document` with the key `error` to stdout, if there is one. Returns the
/// exit status.
ExitCode report_failure(const CommandError& error, Json* document);

/// Returns the text of the document of a verb that failed before it had a result, with the warnings until then.
std::string failure_document(const CommandError& error, const std::vector<Warning>& warnings);

/// Returns the exception that is being handled as an error of the command.
CommandError current_failure();

/// Runs a verb, which adds its warnings to the list as it finds them. An error that ends it carries them.
ExitCode with_warnings(const std::function<ExitCode(std::vector<Warning>&)>& verb);

}  // namespace espalier::tools
