#include "limit_guard.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>

#include "base/numbers.hpp"
#include "last_words.hpp"

namespace espalier::tools {

namespace {

constexpr double bytes_of_mib = 1024.0 * 1024.0;

std::atomic<bool> allocation_failed = false;
LastWords time_words;

void note_failed_allocation() {
    allocation_failed = true;
    throw std::bad_alloc();
}

void end_with_time_words(int) { end_with(time_words); }

/// Bytes of address space that the process has now; 0 where the system does not tell.
std::uint64_t address_space() {
    std::ifstream file("/proc/self/statm");
    std::uint64_t pages = 0;
    file >> pages;
    return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void* noted(void* memory, std::size_t bytes) {
    if (memory == nullptr && bytes != 0) allocation_failed = true;
    return memory;
}

}  // namespace

LimitGuard::LimitGuard(const std::string& path, const ImportOptions& options) : path_(path), limits_(options.limits) {
    allocation_failed = false;
    handler_before_ = std::set_new_handler(note_failed_allocation);
    limit_memory();
    limit_time(options);
}

LimitGuard::~LimitGuard() {
    if (limits_.seconds > 0.0) {
        ::setitimer(ITIMER_PROF, &timer_before_, nullptr);
        ::sigaction(SIGPROF, &action_before_, nullptr);
    }
    if (limits_.memory > 0) ::setrlimit(RLIMIT_AS, &memory_before_);
    std::set_new_handler(handler_before_);
}

void LimitGuard::limit_memory() {
    if (limits_.memory == 0) return;
    ::getrlimit(RLIMIT_AS, &memory_before_);
    struct rlimit limited = memory_before_;
    const std::uint64_t most = address_space() + limits_.memory;
    if (most > limits_.memory) limited.rlim_cur = std::min<rlim_t>(limited.rlim_cur, most);
    ::setrlimit(RLIMIT_AS, &limited);
}

void LimitGuard::limit_time(const ImportOptions& options) {
    if (limits_.seconds <= 0.0) return;
    time_words = last_words({ExitCode::invalid_input,
                             text("'", printable(path_), "': reading it took more than ", rounded(limits_.seconds),
                                  " s of processor time, the limit of --import-seconds. The file is likely broken; if "
                                  "it is not, raise the limit."),
                             {.file = path_, .kind = "import_seconds"}},
                            options);
    struct sigaction action {};
    action.sa_handler = end_with_time_words;
    ::sigaction(SIGPROF, &action, &action_before_);
    double whole = 0.0;
    const double fraction = std::modf(limits_.seconds, &whole);
    struct itimerval timer {};
    timer.it_value.tv_sec = static_cast<time_t>(whole);
    timer.it_value.tv_usec = static_cast<suseconds_t>(fraction * 1e6);
    ::setitimer(ITIMER_PROF, &timer, &timer_before_);
}

bool LimitGuard::memory_ran_out() const { return allocation_failed; }

void LimitGuard::refuse_memory() const {
    throw CommandError(ExitCode::invalid_input,
                       limits_.memory == 0
                           ? text("'", printable(path_), "': the machine has not enough memory to read it.")
                           : text("'", printable(path_), "': reading it takes more than ",
                                  rounded(static_cast<double>(limits_.memory) / bytes_of_mib),
                                  " MiB of memory, the limit of --import-memory. The file is likely broken; if it is "
                                  "not, raise the limit."),
                       {.file = path_, .kind = "import_memory"});
}

std::uint64_t default_import_memory() {
    const auto pages = static_cast<std::uint64_t>(std::max(0L, ::sysconf(_SC_PHYS_PAGES)));
    return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) / 2;
}

}  // namespace espalier::tools

// Libraries that take memory from malloc make a smaller file of a failure. glibc lets a program replace malloc, and
// has its own under another name; the rest of its functions stays. Sanitizers replace malloc themselves.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer) || __has_feature(thread_sanitizer)
#define ESPALIER_SANITIZED_MALLOC
#endif
#endif
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && \
    !defined(ESPALIER_SANITIZED_MALLOC)
extern "C" {
void* __libc_malloc(std::size_t bytes);
void* __libc_calloc(std::size_t count, std::size_t bytes);
void* __libc_realloc(void* memory, std::size_t bytes);

void* malloc(std::size_t bytes) noexcept { return espalier::tools::noted(__libc_malloc(bytes), bytes); }
void* calloc(std::size_t count, std::size_t bytes) noexcept {
    return espalier::tools::noted(__libc_calloc(count, bytes), count == 0 ? 0 : bytes);
}
void* realloc(void* memory, std::size_t bytes) noexcept {
    return espalier::tools::noted(__libc_realloc(memory, bytes), bytes);
}
}
#endif
