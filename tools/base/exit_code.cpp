#include "exit_code.hpp"

#include <cstring>

namespace espalier::tools {

void fail_to_read(const std::string& path, const char* reason) {
    throw CommandError(ExitCode::file_access,
                       text("cannot read '", printable(path), "': ", reason, ". Check the path and the rights on it."),
                       {.file = path});
}

void fail_to_read(const std::string& path, int error) { fail_to_read(path, std::strerror(error)); }

}  // namespace espalier::tools
