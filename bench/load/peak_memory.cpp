#include "ways.hpp"

#ifdef __linux__
#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <exception>
#include <fstream>

#endif

namespace espalier::bench {

#ifdef __linux__

namespace {

/// Linux counts pages in batches of 64 for each of two kinds.
constexpr std::size_t resolution = std::size_t{2 * 64} << 12;

constexpr int map_threshold = 1 << 17;  // glibc's default, which a fixed value keeps from growing

/// Returns a line of /proc/self/status, in bytes.
std::size_t status_of_process(const std::string& field) {
    std::ifstream status("/proc/self/status");
    std::string word;
    while (status >> word)
        if (word == field) {
            std::size_t kib = 0;
            status >> kib;
            return 1024 * kib;
        }
    return 0;
}

/// Sets the peak to what is resident now. Returns whether the system did.
bool reset_peak() {
    std::ofstream clear("/proc/self/clear_refs");
    clear << "5" << std::flush;
    return clear.good();
}

/// Returns what the child measures; 0 if it cannot.
std::size_t measure(const std::function<void()>& work) {
    mallopt(M_MMAP_THRESHOLD, map_threshold);
    work();
    // What is free again is given back, so that it counts when it is taken once more.
    malloc_trim(0);
    if (!reset_peak()) return 0;
    const std::size_t before = status_of_process("VmRSS:");
    work();
    const std::size_t peak = status_of_process("VmHWM:");
    return peak > before ? peak - before : 0;
}

}  // namespace

std::optional<std::size_t> peak_memory(const std::function<void()>& work) {
    int ends[2];
    if (pipe(ends) != 0) return std::nullopt;
    const pid_t child = fork();
    if (child == 0) {
        std::size_t bytes = 0;
        try {
            bytes = measure(work);
        } catch (const std::exception&) {
            _exit(1);
        }
        _exit(write(ends[1], &bytes, sizeof bytes) == static_cast<ssize_t>(sizeof bytes) ? 0 : 1);
    }
    close(ends[1]);
    std::size_t bytes = 0;
    const bool is_read = child > 0 && read(ends[0], &bytes, sizeof bytes) == static_cast<ssize_t>(sizeof bytes);
    close(ends[0]);
    if (child > 0) waitpid(child, nullptr, 0);
    if (!is_read || bytes < resolution) return std::nullopt;
    return bytes;
}

#else

std::optional<std::size_t> peak_memory(const std::function<void()>&) { return std::nullopt; }

#endif

}  // namespace espalier::bench
