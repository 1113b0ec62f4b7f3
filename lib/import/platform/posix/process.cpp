#include <import/platform/process.hpp>

#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <limits>

namespace espalier::importer {

namespace {

bool are_one_file(const struct stat& a, const struct stat& b) { return a.st_dev == b.st_dev && a.st_ino == b.st_ino; }

void write_to(int descriptor, std::string_view words) {
    const ssize_t written = ::write(descriptor, words.data(), words.size());
    static_cast<void>(written);
}

struct BlockedSignals {
    BlockedSignals() {
        sigset_t held;
        sigemptyset(&held);
        for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) sigaddset(&held, signal);
        pthread_sigmask(SIG_BLOCK, &held, &before);
    }
    ~BlockedSignals() { pthread_sigmask(SIG_SETMASK, &before, nullptr); }

    sigset_t before;
};

constexpr std::array<int, 5> crash_signals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

struct CrashSignals {
    CrashSignals(void (*handler)(int), std::size_t stack_bytes) : stack(stack_bytes) {
        stack_t memory{};
        memory.ss_sp = stack.data();
        memory.ss_size = stack.size();
        ::sigaltstack(&memory, &stack_before);
        struct sigaction action {};
        action.sa_handler = handler;
        action.sa_flags = SA_ONSTACK;
        for (std::size_t i = 0; i < before.size(); ++i) ::sigaction(crash_signals[i], &action, &before[i]);
    }
    ~CrashSignals() {
        for (std::size_t i = 0; i < before.size(); ++i) ::sigaction(crash_signals[i], &before[i], nullptr);
        ::sigaltstack(&stack_before, nullptr);
    }

    std::array<struct sigaction, crash_signals.size()> before;
    std::vector<char> stack;
    stack_t stack_before;
};

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

struct MemoryLimit {
    explicit MemoryLimit(std::uint64_t added_bytes) : error(limit_address_space(added_bytes, before)) {}
    ~MemoryLimit() {
        if (error == 0) ::setrlimit(RLIMIT_AS, &before);
    }

    struct rlimit before {};
    int error;
};

void (*handle_end_of_time)() = nullptr;

void on_timer(int) { handle_end_of_time(); }

struct ProcessorTimeLimit {
    explicit ProcessorTimeLimit(double seconds) {
        struct sigaction action {};
        action.sa_handler = on_timer;
        if (::sigaction(SIGPROF, &action, &action_before) != 0) {
            error = errno;
            return;
        }
        double whole = 0.0;
        const double fraction = std::modf(seconds, &whole);
        struct itimerval timer {};
        timer.it_value.tv_sec = static_cast<time_t>(whole);
        timer.it_value.tv_usec = static_cast<suseconds_t>(fraction * 1e6);
        if (::setitimer(ITIMER_PROF, &timer, &timer_before) == 0) return;
        error = errno;
        ::sigaction(SIGPROF, &action_before, nullptr);
    }
    ~ProcessorTimeLimit() {
        if (error != 0) return;
        ::setitimer(ITIMER_PROF, &timer_before, nullptr);
        ::sigaction(SIGPROF, &action_before, nullptr);
    }

    struct sigaction action_before {};
    struct itimerval timer_before {};
    int error = 0;
};

}  // namespace

std::vector<std::string> words_of_command_line(int count, char** values) {
    return {values + std::min(count, 1), values + count};
}

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

Guard hold_interrupts() { return std::make_shared<BlockedSignals>(); }

Guard handle_crashes(void (*handler)(int), std::size_t stack_bytes) {
    return std::make_shared<CrashSignals>(handler, stack_bytes);
}

int limit_memory(std::uint64_t added_bytes, Guard& guard) {
    if (added_bytes == 0) return 0;
    const auto limit = std::make_shared<MemoryLimit>(added_bytes);
    guard = limit;
    return limit->error;
}

int limit_processor_time(double seconds, void (*handler)(), Guard& guard) {
    if (seconds <= 0.0) return 0;
    handle_end_of_time = handler;
    const auto limit = std::make_shared<ProcessorTimeLimit>(seconds);
    guard = limit;
    return limit->error;
}

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

}  // namespace espalier::importer
