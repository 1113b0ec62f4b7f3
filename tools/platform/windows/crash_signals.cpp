#include "platform/crash_signals.hpp"

#include <windows.h>

#include <signal.h>

namespace espalier::tools {

namespace {

void (*handle_crash)(int) = nullptr;

int signal_of(DWORD exception) {
    switch (exception) {
        case EXCEPTION_ILLEGAL_INSTRUCTION:
        case EXCEPTION_PRIV_INSTRUCTION:
            return SIGILL;
        case EXCEPTION_INT_DIVIDE_BY_ZERO:
        case EXCEPTION_INT_OVERFLOW:
            return SIGFPE;
        default:
            return SIGSEGV;
    }
}

LONG WINAPI on_exception(EXCEPTION_POINTERS* exception) {
    handle_crash(signal_of(exception->ExceptionRecord->ExceptionCode));
    return EXCEPTION_CONTINUE_SEARCH;
}

}  // namespace

struct CrashSignals::State {
    LPTOP_LEVEL_EXCEPTION_FILTER filter_before = nullptr;
    void (*abort_before)(int) = SIG_DFL;
};

CrashSignals::CrashSignals(void (*handler)(int), std::size_t stack_bytes) : state_(std::make_unique<State>()) {
    handle_crash = handler;
    ULONG reserve = static_cast<ULONG>(stack_bytes);
    ::SetThreadStackGuarantee(&reserve);  // what is left of the stack when it has run out
    state_->filter_before = ::SetUnhandledExceptionFilter(on_exception);
    state_->abort_before = ::signal(SIGABRT, handler);
}

CrashSignals::~CrashSignals() {
    ::signal(SIGABRT, state_->abort_before);
    ::SetUnhandledExceptionFilter(state_->filter_before);
}

}  // namespace espalier::tools
