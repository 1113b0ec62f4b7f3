// Guards against files of strangers, which libraries that are not ours read and that cannot be interrupted: limits on
// memory and time, and a message where one crashes.
#pragma once

#include <string>

#include <espalier/import.hpp>

#include <import/base/error.hpp>
#include <import/platform/process.hpp>

namespace espalier::importer {

/// Returns the error of a library that crashed while it read the file.
ImportError crash_error(const std::string& path);
/// Returns the error of a file that took longer than the limit to read.
ImportError time_error(const std::string& path, const ImportLimits& limits);

/// Writes them and ends the process at once. Safe in a signal handler.
[[noreturn]] void end_with(const LastWords& words);

/// What a program's own malloc calls when it fails, if it has one: LimitGuard::memory_ran_out() counts it.
void note_failed_allocation();

/// While it lives, the process can add so much address space and no more: an allocation beyond it throws
/// std::bad_alloc. After so much processor time of the process, user and system, the process ends with
/// ImportOptions::last_words. Nothing has been written by then. One at a time.
class LimitGuard {
public:
    /// Throws ImportError (unsupported) where a limit cannot be set.
    LimitGuard(const std::string& path, const ImportOptions& options);

    /// Whether an allocation failed: also one of which the importer made another error, or a file with less in it.
    [[nodiscard]] bool memory_ran_out() const;
    /// Throws ImportError (invalid_input) that names the limit.
    [[noreturn]] void refuse_memory() const;

private:
    std::string path_;
    ImportLimits limits_;
    Guard allocations_, memory_, time_;
};

/// While it lives, a crash of this process (a bad access, a failed assertion, a stack used up) ends it with
/// ImportOptions::last_words about crash_error(path). Does nothing without them. Nothing has been written by then. One
/// at a time.
class CrashGuard {
public:
    CrashGuard(const std::string& path, const ImportOptions& options);

private:
    Guard signals_;
};

}  // namespace espalier::importer
