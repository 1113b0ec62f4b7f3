// The standard streams of the process.
#pragma once

#include <string>
#include <string_view>

namespace espalier::tools {

/// Makes the streams carry bytes as they are, and a console show UTF-8. Call it before they are used.
void prepare_standard_streams();

/// Tests whether stderr is a terminal that obeys escape sequences.
bool is_stderr_terminal();

/// Tests whether the path names what the standard output is: /dev/stdout, or the file that it is redirected to.
/// /dev/null is not: it takes any number of outputs.
bool is_standard_output(const std::string& path);

/// Writes both texts and ends the process at once. Safe in a handler of signals.
[[noreturn]] void end_process(int exit_code, std::string_view to_stderr, std::string_view to_stdout);

}  // namespace espalier::tools
