#include <import/platform/process.hpp>

#include <windows.h>

#include <fcntl.h>
#include <io.h>
#include <psapi.h>
#include <shellapi.h>
#include <signal.h>
#include <stdio.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <limits>
#include <mutex>
#include <system_error>
#include <thread>

#include <import/platform/files.hpp>
#include <import/platform/windows/system.hpp>

namespace espalier::importer {

namespace {

UINT code_page_before = 0;

/// The console outlives the process, and programs after it expect their own code page.
void restore_code_page() { ::SetConsoleOutputCP(code_page_before); }

void write_to(int descriptor, std::string_view words) {
    const int written = ::_write(descriptor, words.data(), static_cast<unsigned>(words.size()));
    static_cast<void>(written);
}

/// The number of a file on its disk.
bool identity_of(HANDLE file, BY_HANDLE_FILE_INFORMATION& identity) {
    return ::GetFileType(file) == FILE_TYPE_DISK && ::GetFileInformationByHandle(file, &identity) != 0;
}

/// Held while a temporary exists: an interrupt is handled by a thread of its own, which waits for it.
std::recursive_mutex writing;

/// Returns that the next handler is due: the system's, which ends the process. No other temporary is begun until then.
BOOL WINAPI wait_for_writing(DWORD) {
    writing.lock();
    return FALSE;
}

void (*handle_crash)(int) = nullptr;

int signal_of(DWORD exception) {
    switch (exception) {
        case EXCEPTION_ILLEGAL_INSTRUCTION:
        case EXCEPTION_PRIV_INSTRUCTION:
            return SIGILL;
        case EXCEPTION_INT_DIVIDE_BY_ZERO:
        case EXCEPTION_INT_OVERFLOW:
            return SIGFPE;
        default:
            return SIGSEGV;
    }
}

LONG WINAPI on_exception(EXCEPTION_POINTERS* exception) {
    handle_crash(signal_of(exception->ExceptionRecord->ExceptionCode));
    return EXCEPTION_CONTINUE_SEARCH;
}

struct CrashHandlers {
    explicit CrashHandlers(void (*handler)(int))
        : filter_before(::SetUnhandledExceptionFilter(on_exception)), abort_before(::signal(SIGABRT, handler)) {}
    ~CrashHandlers() {
        ::signal(SIGABRT, abort_before);
        ::SetUnhandledExceptionFilter(filter_before);
    }

    LPTOP_LEVEL_EXCEPTION_FILTER filter_before;
    void (*abort_before)(int);
};

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

struct MemoryLimit {
    explicit MemoryLimit(std::uint64_t added_bytes) : error(limit_added_memory(added_bytes)) {}
    ~MemoryLimit() {
        if (error == 0) limit_job(0, 0);
    }

    int error;
};

/// A thread that looks at the time used, because Windows sends no signal at its end.
struct ProcessorTimeLimit {
    ProcessorTimeLimit(double seconds, void (*handler)()) {
        double now = 0.0;
        error = find_processor_seconds(now);
        if (error != 0) return;
        try {
            thread = std::thread([this, most = now + seconds, handler] { watch(most, handler); });
        } catch (const std::system_error& failure) {
            error = failure.code().value();
        }
    }
    ~ProcessorTimeLimit() {
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

}  // namespace

/// Those of main are in the code page of the machine, which lacks most letters.
std::vector<std::string> words_of_command_line(int, char**) {
    int count = 0;
    wchar_t** const words = ::CommandLineToArgvW(::GetCommandLineW(), &count);
    std::vector<std::string> result;
    for (int i = 1; i < count; ++i) result.push_back(utf8_of(words[i]));
    ::LocalFree(words);
    return result;
}

void prepare_standard_streams() {
    for (FILE* stream : {stdin, stdout, stderr}) ::_setmode(::_fileno(stream), _O_BINARY);
    code_page_before = ::GetConsoleOutputCP();
    if (code_page_before == 0 || code_page_before == CP_UTF8) return;
    if (::SetConsoleOutputCP(CP_UTF8) != 0) std::atexit(restore_code_page);
}

bool is_stderr_terminal() {
    const HANDLE console = ::GetStdHandle(STD_ERROR_HANDLE);
    DWORD mode = 0;
    if (::GetConsoleMode(console, &mode) == 0) return false;
    return ::SetConsoleMode(console, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING) != 0;
}

bool is_standard_output(const std::string& path) {
    if (path == "/dev/stdout") return true;  // the name that other systems have for it
    const HANDLE file = ::CreateFileW(path_of(path).c_str(), 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                                      nullptr, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr);
    if (file == INVALID_HANDLE_VALUE) return false;
    BY_HANDLE_FILE_INFORMATION named{};
    BY_HANDLE_FILE_INFORMATION standard_output{};
    const bool both_are_files =
        identity_of(file, named) && identity_of(::GetStdHandle(STD_OUTPUT_HANDLE), standard_output);
    ::CloseHandle(file);
    return both_are_files && named.dwVolumeSerialNumber == standard_output.dwVolumeSerialNumber &&
           named.nFileIndexHigh == standard_output.nFileIndexHigh &&
           named.nFileIndexLow == standard_output.nFileIndexLow;
}

void end_process(int exit_code, std::string_view to_stderr, std::string_view to_stdout) {
    write_to(2, to_stderr);
    write_to(1, to_stdout);
    if (code_page_before != 0) restore_code_page();
    ::_exit(exit_code);
}

Guard hold_interrupts() {
    static const BOOL handles = ::SetConsoleCtrlHandler(wait_for_writing, TRUE);
    static_cast<void>(handles);
    return std::make_shared<std::lock_guard<std::recursive_mutex>>(writing);
}

Guard handle_crashes(void (*handler)(int), std::size_t stack_bytes) {
    handle_crash = handler;
    ULONG reserve = static_cast<ULONG>(stack_bytes);
    ::SetThreadStackGuarantee(&reserve);  // what is left of the stack when it has run out
    return std::make_shared<CrashHandlers>(handler);
}

int limit_memory(std::uint64_t added_bytes, Guard& guard) {
    if (added_bytes == 0) return 0;
    const auto limit = std::make_shared<MemoryLimit>(added_bytes);
    guard = limit;
    return limit->error;
}

int limit_processor_time(double seconds, void (*handler)(), Guard& guard) {
    if (seconds <= 0.0) return 0;
    const auto limit = std::make_shared<ProcessorTimeLimit>(seconds, handler);
    guard = limit;
    return limit->error;
}

bool can_limit_memory() { return true; }

std::uint64_t machine_memory() {
    MEMORYSTATUSEX status{};
    status.dwLength = sizeof(status);
    return ::GlobalMemoryStatusEx(&status) != 0 ? status.ullTotalPhys : 0;
}

}  // namespace espalier::importer
