#include "platform/limits.hpp"

#include <windows.h>

#include <psapi.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <system_error>
#include <thread>

#include "errors.hpp"

namespace espalier::tools {

namespace {

struct Job {
    HANDLE handle = nullptr;
    int error = 0;
};

/// The job that limits this process. A process cannot leave a job, so that there is one, whose limit changes.
const Job& job_of_process() {
    static const Job job = [] {
        Job made{::CreateJobObjectW(nullptr, nullptr)};
        if (made.handle == nullptr || ::AssignProcessToJobObject(made.handle, ::GetCurrentProcess()) == 0)
            made.error = last_error();
        return made;
    }();
    return job;
}

/// Sets the limits that the flags name, and no others. Returns 0 or an error.
int limit_job(DWORD flags, SIZE_T bytes) {
    const Job& job = job_of_process();
    if (job.error != 0) return job.error;
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
    limits.BasicLimitInformation.LimitFlags = flags;
    limits.ProcessMemoryLimit = bytes;
    const BOOL is_set =
        ::SetInformationJobObject(job.handle, JobObjectExtendedLimitInformation, &limits, sizeof(limits));
    return is_set != 0 ? 0 : last_error();
}

/// Lets the process commit so many bytes more. Returns 0 or an error.
int limit_added_memory(std::uint64_t bytes) {
    PROCESS_MEMORY_COUNTERS counters{};
    if (::GetProcessMemoryInfo(::GetCurrentProcess(), &counters, sizeof(counters)) == 0) return last_error();
    const SIZE_T now = counters.PagefileUsage;
    const std::uint64_t room = std::numeric_limits<SIZE_T>::max() - now;
    return limit_job(JOB_OBJECT_LIMIT_PROCESS_MEMORY, now + static_cast<SIZE_T>(std::min(bytes, room)));
}

/// Stores the processor time of the process, user and system. Returns 0 or an error.
int find_processor_seconds(double& result) {
    FILETIME created{};
    FILETIME ended{};
    FILETIME system{};
    FILETIME user{};
    if (::GetProcessTimes(::GetCurrentProcess(), &created, &ended, &system, &user) == 0) return last_error();
    const auto seconds = [](const FILETIME& time) {
        constexpr double ticks_per_second = 1e7;
        const std::uint64_t ticks = std::uint64_t{time.dwHighDateTime} << 32 | time.dwLowDateTime;
        return static_cast<double>(ticks) / ticks_per_second;
    };
    result = seconds(system) + seconds(user);
    return 0;
}

}  // namespace

struct MemoryLimit::State {
    int error = 0;
};

MemoryLimit::MemoryLimit(std::uint64_t added_bytes) {
    if (added_bytes != 0) state_ = std::make_unique<State>(State{limit_added_memory(added_bytes)});
}

MemoryLimit::~MemoryLimit() {
    if (state_ && state_->error == 0) limit_job(0, 0);
}

int MemoryLimit::error() const { return state_ ? state_->error : 0; }

/// A thread that looks at the time used, because Windows sends no signal at its end.
struct ProcessorTimeLimit::State {
    State(double seconds, void (*handler)()) {
        double now = 0.0;
        error = find_processor_seconds(now);
        if (error != 0) return;
        try {
            thread = std::thread([this, most = now + seconds, handler] { watch(most, handler); });
        } catch (const std::system_error& failure) {
            error = failure.code().value();
        }
    }
    ~State() {
        if (!thread.joinable()) return;
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
        while (!changed.wait_for(lock, pause, [this] { return done; })) {
            double now = 0.0;
            if (find_processor_seconds(now) != 0 || now > most) handler();
        }
    }

    std::mutex mutex;
    std::condition_variable changed;
    bool done = false;
    int error = 0;
    std::thread thread;
};

ProcessorTimeLimit::ProcessorTimeLimit(double seconds, void (*handler)()) {
    if (seconds > 0.0) state_ = std::make_unique<State>(seconds, handler);
}

ProcessorTimeLimit::~ProcessorTimeLimit() = default;

int ProcessorTimeLimit::error() const { return state_ ? state_->error : 0; }

bool can_limit_memory() { return true; }

std::uint64_t machine_memory() {
    MEMORYSTATUSEX status{};
    status.dwLength = sizeof(status);
    return ::GlobalMemoryStatusEx(&status) != 0 ? status.ullTotalPhys : 0;
}

}  // namespace espalier::tools
