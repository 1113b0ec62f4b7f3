// What a signal handler leaves behind when it ends the process while a file is read.
#pragma once

#include <string>

#include "import/base/imported.hpp"

namespace espalier::tools {

/// Made beforehand: a handler may neither allocate nor lock.
struct LastWords {
    int exit_code = 0;
    std::string to_stderr;
    std::string to_stdout;
};

LastWords last_words(const CommandError& error, const ImportOptions& options);

/// Writes them and ends the process at once. Safe in a signal handler.
[[noreturn]] void end_with(const LastWords& words);

}  // namespace espalier::tools
