// How an import ends, and what it warns of.
#pragma once

#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <import/base/numbers.hpp>

namespace espalier::importer {

struct ImportWarning {
    std::string kind;       ///< one lower-case word or several joined by '_'; scripts branch on it
    std::string message;    ///< whole sentences: what was found, where, and what to do
    std::string file = {};  ///< empty for a warning about no file
    std::optional<std::uint32_t> mesh = {};
    std::optional<std::uint64_t> triangle = {};
};

enum class ImportStatus : std::uint8_t {
    ok,
    invalid_options,  ///< an option is out of its range, or names what does not exist
    file_access,      ///< a file cannot be read
    invalid_input,    ///< a file was read, and its content is broken
    unsupported,      ///< sound, but beyond what this version, this build or the format of blobs can do
    internal,         ///< a defect of ours
};

/// Details of an error for scripts, in addition to status and message. All of them may be empty.
struct ImportErrorDetails {
    std::string file = {};
    std::optional<std::uint32_t> mesh = {};
    std::optional<std::uint64_t> triangle = {};
    std::string kind = {};  ///< narrower than the status; empty: nothing narrower
};

/// Ends an import. The message states what went wrong, where, and what to do about it.
class ImportError : public std::runtime_error {
public:
    ImportError(ImportStatus status, const std::string& message, ImportErrorDetails details = {})
        : std::runtime_error(message), status_(status), details_(std::move(details)) {}
    [[nodiscard]] ImportStatus status() const { return status_; }
    [[nodiscard]] const ImportErrorDetails& details() const { return details_; }

private:
    ImportStatus status_;
    ImportErrorDetails details_;
};

/// Throws ImportError with the parts as its message.
template <class... Parts>
[[noreturn]] void throw_error(ImportStatus status, const Parts&... parts) {
    throw ImportError(status, text(parts...));
}

/// Throws ImportError about a file, whose name in quotes and the parts are its message.
template <class... Parts>
[[noreturn]] void throw_file_error(ImportStatus status, const std::string& path, const Parts&... parts) {
    throw ImportError(status, text('\'', printable(path), '\'', parts...), {.file = path});
}

/// Throws ImportError (file_access) with a reason, which may be a value of errno.
[[noreturn]] inline void fail_to_read(const std::string& path, const char* reason) {
    throw ImportError(ImportStatus::file_access,
                      text("cannot read '", printable(path), "': ", reason, ". Check the path and the rights on it."),
                      {.file = path});
}
[[noreturn]] inline void fail_to_read(const std::string& path, int error) { fail_to_read(path, std::strerror(error)); }

}  // namespace espalier::importer
