// Crashes of this process, handled on memory that is left when the stack has run out.
#pragma once

#include <cstddef>
#include <memory>

namespace espalier::tools {

/// While it lives, `handler` is called with the number of the signal on a bad access, a failed assertion or a stack
/// used up; what was there before comes back after it. One at a time.
class CrashSignals {
public:
    CrashSignals(void (*handler)(int), std::size_t stack_bytes);
    ~CrashSignals();
    CrashSignals(const CrashSignals&) = delete;
    CrashSignals& operator=(const CrashSignals&) = delete;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace espalier::tools
