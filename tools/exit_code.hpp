// How the command ends. The numbers are part of its interface: scripts branch on them.
#pragma once

#include <stdexcept>
#include <string>

namespace espalier::tools {

enum class ExitCode : int {
    ok = 0,
    usage = 1,          ///< the command line cannot be carried out as written
    file_access = 2,    ///< a file cannot be read or written
    invalid_input = 3,  ///< a file was read, and what it says is broken
    internal = 4,       ///< a defect of ours, or a machine out of memory
    unsupported = 5,    ///< sound, but beyond what this version or format can do
    no_answer = 6,      ///< a query was refused or answered in part only
};

inline constexpr const char* exit_code_help =
    "Exit status: 0 ok, 1 usage, 2 file cannot be read or written, 3 invalid input, 4 internal, 5 unsupported, "
    "6 query refused or answered in part.";

/// Ends a verb. The message says what went wrong, where, and what to do about it.
class CommandError : public std::runtime_error {
public:
    CommandError(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
    [[nodiscard]] ExitCode code() const { return code_; }

private:
    ExitCode code_;
};

}  // namespace espalier::tools
