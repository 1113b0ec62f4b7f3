#include "platform/limits.hpp"

#include <windows.h>

#include <psapi.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace espalier::tools {

namespace {

/// Memory that the process has committed.
std::uint64_t committed_bytes() {
    PROCESS_MEMORY_COUNTERS counters{};
    ::GetProcessMemoryInfo(::GetCurrentProcess(), &counters, sizeof(counters));
    return counters.PagefileUsage;
}

/// The job that limits this process. A process cannot leave a job, so that there is one, whose limit changes.
HANDLE job_of_process() {
    static const HANDLE job = [] {
        const HANDLE made = ::CreateJobObjectW(nullptr, nullptr);
        ::AssignProcessToJobObject(made, ::GetCurrentProcess());
        return made;
    }();
    return job;
}

void limit_job(DWORD flags, std::uint64_t bytes) {
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
    limits.BasicLimitInformation.LimitFlags = flags;
    limits.ProcessMemoryLimit = static_cast<SIZE_T>(bytes);
    ::SetInformationJobObject(job_of_process(), JobObjectExtendedLimitInformation, &limits, sizeof(limits));
}

/// Processor time of the process, user and system.
double processor_seconds() {
    FILETIME created{};
    FILETIME ended{};
    FILETIME system{};
    FILETIME user{};
    ::GetProcessTimes(::GetCurrentProcess(), &created, &ended, &system, &user);
    const auto seconds = [](const FILETIME& time) {
        constexpr double ticks_per_second = 1e7;
        const std::uint64_t ticks = std::uint64_t{time.dwHighDateTime} << 32 | time.dwLowDateTime;
        return static_cast<double>(ticks) / ticks_per_second;
    };
    return seconds(system) + seconds(user);
}

}  // namespace

struct MemoryLimit::State {};

MemoryLimit::MemoryLimit(std::uint64_t added_bytes) {
    if (added_bytes == 0) return;
    state_ = std::make_unique<State>();
    limit_job(JOB_OBJECT_LIMIT_PROCESS_MEMORY, committed_bytes() + added_bytes);
}

MemoryLimit::~MemoryLimit() {
    if (state_) limit_job(0, 0);
}

/// A thread that looks at the time used, because Windows sends no signal at its end.
struct ProcessorTimeLimit::State {
    State(double most, void (*handler)()) : thread([this, most, handler] { watch(most, handler); }) {}
    ~State() {
        {
            const std::lock_guard lock(mutex);
            done = true;
        }
        changed.notify_one();
        thread.join();
    }

    void watch(double most, void (*handler)()) {
        constexpr auto pause = std::chrono::milliseconds(10);
        std::unique_lock lock(mutex);
        while (!changed.wait_for(lock, pause, [this] { return done; }))
            if (processor_seconds() > most) handler();
    }

    std::mutex mutex;
    std::condition_variable changed;
    bool done = false;
    std::thread thread;
};

ProcessorTimeLimit::ProcessorTimeLimit(double seconds, void (*handler)()) {
    if (seconds > 0.0) state_ = std::make_unique<State>(processor_seconds() + seconds, handler);
}

ProcessorTimeLimit::~ProcessorTimeLimit() = default;

std::uint64_t machine_memory() {
    MEMORYSTATUSEX status{};
    status.dwLength = sizeof(status);
    return ::GlobalMemoryStatusEx(&status) != 0 ? status.ullTotalPhys : 0;
}

}  // namespace espalier::tools
