// How an import ends without meshes, and what its messages are made of.
#pragma once

#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <espalier/import.hpp>

#include <import/base/numbers.hpp>

namespace espalier::importer {

/// What a reason has in addition to its message. All of it may be empty.
struct ImportErrorDetails {
    std::string file = {};
    std::optional<std::uint32_t> mesh = {};
    std::optional<std::uint64_t> triangle = {};
    std::string kind = {};
};

/// Ends an import. The message states what went wrong, where, and what to do about it.
class ImportError : public std::runtime_error {
public:
    ImportError(ImportStatus status, const std::string& message, ImportErrorDetails details = {})
        : std::runtime_error(message), status_(status), details_(std::move(details)) {}
    [[nodiscard]] ImportStatus status() const { return status_; }
    [[nodiscard]] const ImportErrorDetails& details() const { return details_; }
    [[nodiscard]] ImportDiagnostic reason() const {
        return {details_.kind, what(), details_.file, details_.mesh, details_.triangle};
    }

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
