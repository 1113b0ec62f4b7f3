#include "limit_guard.hpp"

#include <atomic>

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

void end_with_time_words() { end_with(time_words); }

[[maybe_unused]] void* noted(void* memory, std::size_t bytes) {
    if (memory == nullptr && bytes != 0) allocation_failed = true;
    return memory;
}

std::new_handler note_allocations_that_fail() {
    allocation_failed = false;
    return std::set_new_handler(note_failed_allocation);
}

auto handler_that_names(const std::string& path, const ImportOptions& options) {
    time_words =
        last_words({ExitCode::invalid_input,
                    text("'", printable(path), "': reading it took more than ", rounded(options.limits.seconds),
                         " s of processor time, the limit of --import-seconds. The file is likely broken; if it is "
                         "not, raise the limit."),
                    {.file = path, .kind = "import_seconds"}},
                   options);
    return end_with_time_words;
}

}  // namespace

LimitGuard::LimitGuard(const std::string& path, const ImportOptions& options)
    : path_(path),
      limits_(options.limits),
      handler_before_(note_allocations_that_fail()),
      memory_(limits_.memory),
      time_(limits_.seconds, handler_that_names(path, options)) {}

LimitGuard::~LimitGuard() { std::set_new_handler(handler_before_); }

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

std::uint64_t default_import_memory() { return machine_memory() / 2; }

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
