#include "limit_guard.hpp"

#include <atomic>
#include <cstring>
#include <new>
#include <string_view>

#include "base/numbers.hpp"

namespace espalier::tools {

namespace {

constexpr double bytes_of_mib = 1024.0 * 1024.0;

std::atomic<bool> allocation_failed = false;
LastWords time_words;

void note_failed_allocation() {
    allocation_failed = true;
    throw std::bad_alloc();
}

/// While it lives, allocations that fail are noted.
struct NotedAllocations {
    NotedAllocations() : before(std::set_new_handler(note_failed_allocation)) { allocation_failed = false; }
    ~NotedAllocations() { std::set_new_handler(before); }

    std::new_handler before;
};

void end_with_time_words() { end_with(time_words); }

[[maybe_unused]] void* noted(void* memory, std::size_t bytes) {
    if (memory == nullptr && bytes != 0) allocation_failed = true;
    return memory;
}

auto time_handler_that_names(const std::string& path, const ImportOptions& options) {
    time_words =
        last_words({ExitCode::invalid_input,
                    text("'", printable(path), "': reading it took more than ", rounded(options.limits.seconds),
                         " s of processor time, the limit of --import-seconds. The file is likely broken; if it is "
                         "not, raise the limit."),
                    {.file = path, .kind = "import_seconds"}},
                   options);
    return end_with_time_words;
}

/// Throws CommandError (unsupported) for an error.
void require_set(int error, const std::string& path, const char* kind, std::string_view option,
                 std::string_view remedy) {
    if (error == 0) return;
    throw CommandError(
        ExitCode::unsupported,
        text("'", printable(path), "': the limit of ", option, " cannot be set: ", std::strerror(error), ". ", remedy),
        {.file = path, .kind = kind});
}

}  // namespace

LastWords last_words(const CommandError& error, const ImportOptions& options) {
    return {static_cast<int>(error.code()), text("espalier: ", error.what(), '\n'),
            options.failure_document ? options.failure_document(error) : std::string()};
}

void end_with(const LastWords& words) { end_process(words.exit_code, words.to_stderr, words.to_stdout); }

LimitGuard::LimitGuard(const std::string& path, const ImportOptions& options)
    : path_(path), limits_(options.limits), allocations_(std::make_shared<NotedAllocations>()) {
    require_set(limit_memory(limits_.memory, memory_), path, "import_memory", "--import-memory",
                "For files that you trust, --import-memory none reads without it.");
    require_set(limit_processor_time(limits_.seconds, time_handler_that_names(path, options), time_), path,
                "import_seconds", "--import-seconds", "End other programs, and try again.");
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
    if (!can_limit_memory()) return 0;
    const std::uint64_t memory = machine_memory();
    if (memory != 0) return memory / 2;
    throw_error(ExitCode::unsupported,
                "--import-memory: the system does not report how much memory the machine has, of which half is the "
                "limit without this option. Give an amount such as 4G, or none.");
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
// NOLINTBEGIN(bugprone-reserved-identifier): they are glibc's
void* __libc_malloc(std::size_t bytes);
void* __libc_calloc(std::size_t count, std::size_t bytes);
void* __libc_realloc(void* memory, std::size_t bytes);
// NOLINTEND(bugprone-reserved-identifier)

void* malloc(std::size_t bytes) noexcept { return espalier::tools::noted(__libc_malloc(bytes), bytes); }
void* calloc(std::size_t count, std::size_t bytes) noexcept {
    return espalier::tools::noted(__libc_calloc(count, bytes), count == 0 ? 0 : bytes);
}
void* realloc(void* memory, std::size_t bytes) noexcept {
    return espalier::tools::noted(__libc_realloc(memory, bytes), bytes);
}
}
#endif
