#include "platform/crash_signals.hpp"

#include <signal.h>

#include <array>
#include <vector>

namespace espalier::tools {

namespace {

constexpr std::array<int, 5> signals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

}  // namespace

struct CrashSignals::State {
    std::array<struct sigaction, signals.size()> before;
    std::vector<char> stack;
    stack_t stack_before;
};

CrashSignals::CrashSignals(void (*handler)(int), std::size_t stack_bytes) : state_(std::make_unique<State>()) {
    state_->stack.resize(stack_bytes);
    stack_t stack{};
    stack.ss_sp = state_->stack.data();
    stack.ss_size = state_->stack.size();
    ::sigaltstack(&stack, &state_->stack_before);
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = SA_ONSTACK;
    for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], &action, &state_->before[i]);
}

CrashSignals::~CrashSignals() {
    for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], &state_->before[i], nullptr);
    ::sigaltstack(&state_->stack_before, nullptr);
}

}  // namespace espalier::tools
