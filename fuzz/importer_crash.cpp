#include "importer_crash.hpp"

#include <dlfcn.h>
#include <execinfo.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cstring>

#include <import/guards/limit_guard.hpp>

namespace {

bool is_expected = false;

bool is_within_importer() {
    std::array<void*, 512> frames;
    const int count = ::backtrace(frames.data(), static_cast<int>(frames.size()));
    for (int i = 0; i < count; ++i) {
        Dl_info info{};
        if (::dladdr(frames[static_cast<std::size_t>(i)], &info) == 0 || info.dli_fname == nullptr) continue;
        for (const char* library : {"libassimp", "libdraco"}) {
            if (std::strstr(info.dli_fname, library) != nullptr) return true;
        }
    }
    return false;
}

void end_if_within_importer(espalier::fuzz::ImportEnd end) {
    if (is_expected && is_within_importer()) ::_exit(static_cast<int>(end));
}

void on_alarm(int) {
    end_if_within_importer(espalier::fuzz::ImportEnd::too_slow);
    ::signal(SIGALRM, SIG_DFL);
    ::raise(SIGALRM);
}

void on_crash(int number) {
    end_if_within_importer(espalier::fuzz::ImportEnd::crashed);
    std::array<void*, 64> frames;
    ::backtrace_symbols_fd(frames.data(), ::backtrace(frames.data(), static_cast<int>(frames.size())), STDERR_FILENO);
    ::signal(number, SIG_DFL);
    ::raise(number);
}

}  // namespace

namespace espalier::fuzz {

void expect_importer_crashes(unsigned seconds) {
    void* frame = nullptr;
    ::backtrace(&frame, 1);  // loads what it needs, which a signal handler must not
    is_expected = true;
    ::signal(SIGALRM, on_alarm);
    ::alarm(seconds);
}

}  // namespace espalier::fuzz

// In place of the command's guard, which takes every crash while a file is read for one of assimp.
namespace espalier::importer {

CrashGuard::CrashGuard(const std::string&, const ImportOptions&)
    : signals_(handle_crashes(on_crash, std::size_t{1} << 18)) {}

}  // namespace espalier::importer

// The address sanitizer asks and tells these.
extern "C" void __asan_on_error() { end_if_within_importer(espalier::fuzz::ImportEnd::crashed); }
extern "C" const char* __asan_default_options() { return "max_allocation_size_mb=1024"; }
