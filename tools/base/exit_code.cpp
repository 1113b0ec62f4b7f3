#include "exit_code.hpp"

#include <cstring>

#include "numbers.hpp"

namespace espalier::tools {

void fail_to_read(const std::string& path, int error) {
    throw CommandError(
        ExitCode::file_access,
        text("cannot read '", printable(path), "': ", std::strerror(error), ". Check the path and the rights on it."),
        {.file = path});
}

}  // namespace espalier::tools
