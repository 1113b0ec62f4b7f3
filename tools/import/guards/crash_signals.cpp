#include "crash_signals.hpp"

namespace espalier::tools {

CrashSignals::CrashSignals(void (*handler)(int), std::size_t stack_bytes) : stack_(stack_bytes) {
    stack_t stack{};
    stack.ss_sp = stack_.data();
    stack.ss_size = stack_.size();
    ::sigaltstack(&stack, &stack_before_);
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = SA_ONSTACK;
    for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], &action, &before_[i]);
}

CrashSignals::~CrashSignals() {
    for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], &before_[i], nullptr);
    ::sigaltstack(&stack_before_, nullptr);
}

}  // namespace espalier::tools
