#include <import/guards/limit_guard.hpp>

#include <atomic>
#include <cstring>
#include <new>
#include <string_view>

#include <import/base/numbers.hpp>

namespace espalier::importer {

namespace {

constexpr double bytes_of_mib = 1024.0 * 1024.0;

std::atomic<bool> allocation_failed = false;
LastWords time_words;

[[noreturn]] void refuse_allocation() {
    note_failed_allocation();
    throw std::bad_alloc();
}

/// While it lives, allocations that fail are noted.
struct NotedAllocations {
    NotedAllocations() : before(std::set_new_handler(refuse_allocation)) { allocation_failed = false; }
    ~NotedAllocations() { std::set_new_handler(before); }

    std::new_handler before;
};

void end_with_time_words() { end_with(time_words); }

auto time_handler_that_names(const std::string& path, const ImportOptions& options) {
    const ImportError error = time_error(path, options.limits);
    if (options.last_words) time_words = options.last_words(error.reason());
    else time_words = {.to_stderr = text(error.what(), '\n'), .to_stdout = {}};
    return end_with_time_words;
}

/// Throws ImportError (unsupported) for an error.
void require_set(int error, const std::string& path, const char* kind, std::string_view option,
                 std::string_view remedy) {
    if (error == 0) return;
    throw ImportError(
        ImportStatus::unsupported,
        text("'", printable(path), "': the limit of ", option, " cannot be set: ", std::strerror(error), ". ", remedy),
        {.file = path, .kind = kind});
}

}  // namespace

void note_failed_allocation() { allocation_failed = true; }

ImportError crash_error(const std::string& path) {
    return {ImportStatus::invalid_input,
            text("the importer crashed while it read '", printable(path),
                 "': a mistake of the importer, which the file may have caused by being broken. "
                 "Export it again, or in another format, such as glTF."),
            {.file = path, .kind = "importer_crash"}};
}

ImportError time_error(const std::string& path, const ImportLimits& limits) {
    return {ImportStatus::invalid_input,
            text("'", printable(path), "': reading it took more than ", rounded(limits.seconds),
                 " s of processor time, the limit of --import-seconds. The file is likely broken; if it is "
                 "not, raise the limit."),
            {.file = path, .kind = "import_seconds"}};
}

void end_with(const LastWords& words) { end_process(words.exit_status, words.to_stderr, words.to_stdout); }

LimitGuard::LimitGuard(const std::string& path, const ImportOptions& options)
    : path_(path), limits_(options.limits), allocations_(std::make_shared<NotedAllocations>()) {
    require_set(limit_memory(limits_.memory, memory_), path, "import_memory", "--import-memory",
                "For files that you trust, --import-memory none reads without it.");
    require_set(limit_processor_time(limits_.seconds, time_handler_that_names(path, options), time_), path,
                "import_seconds", "--import-seconds", "End other programs, and try again.");
}

bool LimitGuard::memory_ran_out() const { return allocation_failed; }

void LimitGuard::refuse_memory() const {
    throw ImportError(ImportStatus::invalid_input,
                      limits_.memory == 0
                          ? text("'", printable(path_), "': the machine has not enough memory to read it.")
                          : text("'", printable(path_), "': reading it takes more than ",
                                 rounded(static_cast<double>(limits_.memory) / bytes_of_mib),
                                 " MiB of memory, the limit of --import-memory. The file is likely broken; if it is "
                                 "not, raise the limit."),
                      {.file = path_, .kind = "import_memory"});
}

}  // namespace espalier::importer

namespace espalier {

std::optional<std::uint64_t> default_import_memory() {
    if (!importer::can_limit_memory()) return 0;
    const std::uint64_t memory = importer::machine_memory();
    return memory == 0 ? std::nullopt : std::optional(memory / 2);
}

}  // namespace espalier
