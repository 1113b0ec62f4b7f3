// How the command ends, and what it warns of. The numbers are part of its interface: scripts branch on them.
#pragma once

#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <espalier/import.hpp>

#include <import/base/numbers.hpp>

namespace espalier::tools {

using namespace importer;  // whose numbers, placements and files the command uses throughout

/// Those of a bake have the parts of those of its files. Kinds are part of the command's interface.
using Warning = ImportDiagnostic;

enum class ExitCode : int {
    ok = 0,
    usage = 1,          ///< the command line cannot be carried out as written
    file_access = 2,    ///< a file cannot be read or written
    invalid_input = 3,  ///< a file was read, and its content is broken
    internal = 4,       ///< a defect of ours, or a machine out of memory
    unsupported = 5,    ///< sound, but beyond what this version or format can do
    no_answer = 6,      ///< a query was refused or answered in part only
};

inline constexpr const char* exit_code_help =
    "Exit status: 0 ok, 1 usage, 2 file cannot be read or written, 3 invalid input, 4 internal, 5 unsupported, "
    "6 query refused or answered in part.";

/// The name of an exit status: "invalid_input".
constexpr const char* name_of(ExitCode code) {
    constexpr const char* names[] = {"ok",       "usage",       "file_access", "invalid_input",
                                     "internal", "unsupported", "no_answer"};
    return names[static_cast<int>(code)];
}

/// Details of an error for scripts, in addition to exit status and message. All of them may be empty.
struct ErrorDetails {
    std::string file = {};
    std::optional<std::uint32_t> mesh = {};
    std::optional<std::uint64_t> triangle = {};
    std::string kind = {};               ///< narrower than the exit status; empty: that one's name
    std::vector<Warning> warnings = {};  ///< until then; with_warnings sets them
};

/// Ends a verb. The message states what went wrong, where, and what to do about it.
class CommandError : public std::runtime_error {
public:
    CommandError(ExitCode code, const std::string& message, ErrorDetails details = {})
        : std::runtime_error(message), code_(code), details_(std::move(details)) {
        if (details_.kind.empty()) details_.kind = name_of(code);
    }
    [[nodiscard]] ExitCode code() const { return code_; }
    [[nodiscard]] const ErrorDetails& details() const { return details_; }

private:
    ExitCode code_;
    ErrorDetails details_;
};

/// Throws CommandError with the parts as its message.
template <class... Parts>
[[noreturn]] void throw_error(ExitCode code, const Parts&... parts) {
    throw CommandError(code, text(parts...));
}

/// Throws CommandError about a file, whose name in quotes and the parts are its message.
template <class... Parts>
[[noreturn]] void throw_file_error(ExitCode code, const std::string& path, const Parts&... parts) {
    throw CommandError(code, text('\'', printable(path), '\'', parts...), {.file = path});
}

/// Throws CommandError (file_access) with a reason, which may be a value of errno.
[[noreturn]] inline void fail_to_read(const std::string& path, const char* reason) {
    throw CommandError(ExitCode::file_access,
                       text("cannot read '", printable(path), "': ", reason, ". Check the path and the rights on it."),
                       {.file = path});
}
[[noreturn]] inline void fail_to_read(const std::string& path, int error) { fail_to_read(path, std::strerror(error)); }

}  // namespace espalier::tools
