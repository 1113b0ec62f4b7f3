// The importer parses files of strangers in a library that is not ours: when it crashes, the user learns which file did
// it, and scripts see the exit status of invalid input.
#pragma once

#include <signal.h>

#include <array>
#include <string>
#include <vector>

namespace espalier::tools {

/// While it lives, a crash of this process (a bad access, a failed assertion, a stack used up) ends it with
/// ExitCode::invalid_input and a message that names `path`. Nothing has been written by then. One at a time.
class CrashGuard {
public:
    explicit CrashGuard(const std::string& path);
    ~CrashGuard();
    CrashGuard(const CrashGuard&) = delete;
    CrashGuard& operator=(const CrashGuard&) = delete;

private:
    static constexpr std::array<int, 5> signals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
    std::array<struct sigaction, signals.size()> before_;
    std::vector<char> stack_;  // of its own: the usual one may be what ran out
    stack_t stack_before_;
};

}  // namespace espalier::tools
