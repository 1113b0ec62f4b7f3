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

}  // namespace

CrashGuard::CrashGuard(const std::string& path) : stack_(std::size_t{1} << 16) {
    last_words = text("espalier: the importer crashed while it read '", printable(path),
                      "'. The file is likely broken; export it again, or in another format.\n");
    stack_t stack{};
    stack.ss_sp = stack_.data();
    stack.ss_size = stack_.size();
    ::sigaltstack(&stack, &stack_before_);
    struct sigaction action {};
    action.sa_handler = end_with_last_words;
    action.sa_flags = SA_ONSTACK;
    for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], &action, &before_[i]);
}

CrashGuard::~CrashGuard() {
    for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], &before_[i], nullptr);
    ::sigaltstack(&stack_before_, nullptr);
}

}  // namespace espalier::tools
