#include "crash_guard.hpp"

#include <unistd.h>

#include "exit_code.hpp"
#include "numbers.hpp"

namespace espalier::tools {

namespace {

// A signal handler may neither allocate nor lock, so its words are made beforehand.
std::string last_words;

void end_with_last_words(int) {
    const ssize_t written = ::write(STDERR_FILENO, last_words.data(), last_words.size());
    static_cast<void>(written);
    ::_exit(static_cast<int>(ExitCode::invalid_input));
}

auto handler_that_names(const std::string& path) {
    last_words = text("espalier: the importer crashed while it read '", printable(path),
                      "'. The file is likely broken; export it again, or in another format.\n");
    return end_with_last_words;
}

}  // namespace

CrashGuard::CrashGuard(const std::string& path) : signals_(handler_that_names(path), std::size_t{1} << 16) {}

}  // namespace espalier::tools
