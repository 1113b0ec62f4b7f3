#include "depfile.hpp"

#include "base/exit_code.hpp"
#include "base/numbers.hpp"

namespace espalier::tools {

namespace {

/// As compilers write them: a space gets a backslash, and those before it double; a dollar doubles.
std::string escaped_for_make(const std::string& path) {
    std::string result;
    std::size_t backslashes = 0;
    for (const char character : path) {
        if (character == '\n' || character == '\r') {
            throw CommandError(ExitCode::unsupported,
                               text("'", printable(path),
                                    "': a name with a line break cannot be written to a depfile. Rename the file."));
        }
        if (character == ' ' || character == '\t') result.append(backslashes + 1, '\\');
        if (character == '#') result += '\\';
        if (character == '$') result += '$';
        result += character;
        backslashes = character == '\\' ? backslashes + 1 : 0;
    }
    return result;
}

}  // namespace

std::string depfile_text(const std::string& target, std::span<const std::string> sources) {
    std::string result = escaped_for_make(target) + ':';
    for (const std::string& source : sources) result += " \\\n " + escaped_for_make(source);
    result += '\n';
    return result;
}

}  // namespace espalier::tools
