#include "platform/standard_streams.hpp"

#include <sys/stat.h>
#include <unistd.h>

namespace espalier::tools {

namespace {

bool are_one_file(const struct stat& a, const struct stat& b) { return a.st_dev == b.st_dev && a.st_ino == b.st_ino; }

void write_to(int descriptor, std::string_view words) {
    const ssize_t written = ::write(descriptor, words.data(), words.size());
    static_cast<void>(written);
}

}  // namespace

void prepare_standard_streams() {}

bool is_stderr_terminal() { return ::isatty(STDERR_FILENO) == 1; }

bool is_standard_output(const std::string& path) {
    struct stat file {};
    struct stat standard_output {};
    struct stat null {};
    if (::stat(path.c_str(), &file) != 0 || ::fstat(STDOUT_FILENO, &standard_output) != 0) return false;
    if (::stat("/dev/null", &null) == 0 && are_one_file(file, null)) return false;
    return are_one_file(file, standard_output);
}

void end_process(int exit_code, std::string_view to_stderr, std::string_view to_stdout) {
    write_to(STDERR_FILENO, to_stderr);
    write_to(STDOUT_FILENO, to_stdout);
    ::_exit(exit_code);
}

}  // namespace espalier::tools
