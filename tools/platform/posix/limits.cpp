#include "platform/limits.hpp"

#include <signal.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>

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

}  // namespace

struct MemoryLimit::State {
    struct rlimit before {};
};

MemoryLimit::MemoryLimit(std::uint64_t added_bytes) {
    if (added_bytes == 0) return;
    state_ = std::make_unique<State>();
    ::getrlimit(RLIMIT_AS, &state_->before);
    struct rlimit limited = state_->before;
    const std::uint64_t most = address_space() + added_bytes;
    if (most > added_bytes) limited.rlim_cur = std::min<rlim_t>(limited.rlim_cur, most);
    ::setrlimit(RLIMIT_AS, &limited);
}

MemoryLimit::~MemoryLimit() {
    if (state_) ::setrlimit(RLIMIT_AS, &state_->before);
}

struct ProcessorTimeLimit::State {
    struct sigaction action_before {};
    struct itimerval timer_before {};
};

ProcessorTimeLimit::ProcessorTimeLimit(double seconds, void (*handler)()) {
    if (seconds <= 0.0) return;
    state_ = std::make_unique<State>();
    handle_end_of_time = handler;
    struct sigaction action {};
    action.sa_handler = on_timer;
    ::sigaction(SIGPROF, &action, &state_->action_before);
    double whole = 0.0;
    const double fraction = std::modf(seconds, &whole);
    struct itimerval timer {};
    timer.it_value.tv_sec = static_cast<time_t>(whole);
    timer.it_value.tv_usec = static_cast<suseconds_t>(fraction * 1e6);
    ::setitimer(ITIMER_PROF, &timer, &state_->timer_before);
}

ProcessorTimeLimit::~ProcessorTimeLimit() {
    if (!state_) return;
    ::setitimer(ITIMER_PROF, &state_->timer_before, nullptr);
    ::sigaction(SIGPROF, &state_->action_before, nullptr);
}

std::uint64_t machine_memory() {
    return static_cast<std::uint64_t>(std::max(0L, ::sysconf(_SC_PHYS_PAGES))) * page_bytes();
}

}  // namespace espalier::tools
