#include "platform/limits.hpp"

#include <signal.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <limits>

namespace espalier::tools {

namespace {

void (*handle_end_of_time)() = nullptr;

void on_timer(int) { handle_end_of_time(); }

std::uint64_t page_bytes() { return static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)); }

/// Bytes of address space that the process has now; 0 where the system does not tell.
std::uint64_t address_space() {
    std::ifstream file("/proc/self/statm");
    std::uint64_t pages = 0;
    file >> pages;
    return pages * page_bytes();
}

/// Stores the limit that there was. Returns 0 or an error.
int limit_address_space(std::uint64_t added_bytes, struct rlimit& before) {
    if (::getrlimit(RLIMIT_AS, &before) != 0) return errno;
    const std::uint64_t now = address_space();
    if (now == 0) return EOPNOTSUPP;
    const std::uint64_t most = now + std::min(added_bytes, std::numeric_limits<std::uint64_t>::max() - now);
    struct rlimit limited = before;
    limited.rlim_cur = static_cast<rlim_t>(std::min<std::uint64_t>(limited.rlim_cur, most));
    return ::setrlimit(RLIMIT_AS, &limited) != 0 ? errno : 0;
}

}  // namespace

struct MemoryLimit::State {
    struct rlimit before {};
    int error = 0;
};

MemoryLimit::MemoryLimit(std::uint64_t added_bytes) {
    if (added_bytes == 0) return;
    state_ = std::make_unique<State>();
    state_->error = limit_address_space(added_bytes, state_->before);
}

MemoryLimit::~MemoryLimit() {
    if (state_ && state_->error == 0) ::setrlimit(RLIMIT_AS, &state_->before);
}

int MemoryLimit::error() const { return state_ ? state_->error : 0; }

struct ProcessorTimeLimit::State {
    struct sigaction action_before {};
    struct itimerval timer_before {};
    int error = 0;
};

ProcessorTimeLimit::ProcessorTimeLimit(double seconds, void (*handler)()) {
    if (seconds <= 0.0) return;
    state_ = std::make_unique<State>();
    handle_end_of_time = handler;
    struct sigaction action {};
    action.sa_handler = on_timer;
    if (::sigaction(SIGPROF, &action, &state_->action_before) != 0) {
        state_->error = errno;
        return;
    }
    double whole = 0.0;
    const double fraction = std::modf(seconds, &whole);
    struct itimerval timer {};
    timer.it_value.tv_sec = static_cast<time_t>(whole);
    timer.it_value.tv_usec = static_cast<suseconds_t>(fraction * 1e6);
    if (::setitimer(ITIMER_PROF, &timer, &state_->timer_before) == 0) return;
    state_->error = errno;
    ::sigaction(SIGPROF, &state_->action_before, nullptr);
}

ProcessorTimeLimit::~ProcessorTimeLimit() {
    if (!state_ || state_->error != 0) return;
    ::setitimer(ITIMER_PROF, &state_->timer_before, nullptr);
    ::sigaction(SIGPROF, &state_->action_before, nullptr);
}

int ProcessorTimeLimit::error() const { return state_ ? state_->error : 0; }

/// Linux states how large the address space of a process is.
bool can_limit_memory() {
#ifdef __linux__
    return true;
#else
    return false;
#endif
}

std::uint64_t machine_memory() {
    return static_cast<std::uint64_t>(std::max(0L, ::sysconf(_SC_PHYS_PAGES))) * page_bytes();
}

}  // namespace espalier::tools
