// What is wrong with a command line, in words for people.
#pragma once

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

#include "base/exit_code.hpp"

namespace espalier::tools {

/// Returns the error of ExitCode::usage for a command line that `app` could not parse.
CommandError usage_error(const CLI::App& app, const CLI::ParseError& error);

}  // namespace espalier::tools
