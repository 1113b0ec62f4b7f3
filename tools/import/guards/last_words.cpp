#include "last_words.hpp"

#include <unistd.h>

#include "base/numbers.hpp"

namespace espalier::tools {

namespace {

void write_to(int descriptor, const std::string& words) {
    const ssize_t written = ::write(descriptor, words.data(), words.size());
    static_cast<void>(written);
}

}  // namespace

LastWords last_words(const CommandError& error, const ImportOptions& options) {
    return {static_cast<int>(error.code()), text("espalier: ", error.what(), '\n'),
            options.failure_document ? options.failure_document(error) : std::string()};
}

void end_with(const LastWords& words) {
    write_to(STDERR_FILENO, words.to_stderr);
    write_to(STDOUT_FILENO, words.to_stdout);
    ::_exit(words.exit_code);
}

}  // namespace espalier::tools
