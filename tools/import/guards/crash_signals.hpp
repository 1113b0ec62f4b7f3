// Handles the signals of a crash on a separate stack, since the usual one may have run out.
#pragma once

#include <signal.h>

#include <array>
#include <cstddef>
#include <vector>

namespace espalier::tools {

/// While it lives, `handler` is called on a bad access, a failed assertion or a stack used up; what was there before
/// comes back after it. One at a time.
class CrashSignals {
public:
    CrashSignals(void (*handler)(int), std::size_t stack_bytes);
    ~CrashSignals();
    CrashSignals(const CrashSignals&) = delete;
    CrashSignals& operator=(const CrashSignals&) = delete;

private:
    static constexpr std::array<int, 5> signals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
    std::array<struct sigaction, signals.size()> before_;
    std::vector<char> stack_;
    stack_t stack_before_;
};

}  // namespace espalier::tools
