// Limits on the memory and the time that reading one file takes. Importers are libraries that cannot be interrupted.
#pragma once

#include <signal.h>
#include <sys/resource.h>
#include <sys/time.h>

#include <new>
#include <string>

#include "import/base/imported.hpp"

namespace espalier::tools {

/// While it lives, the process can add so much address space and no more: an allocation beyond it throws
/// std::bad_alloc. After so much processor time of the process, user and system, the process ends with
/// ExitCode::invalid_input and a message. Nothing has been written by then. One at a time.
class LimitGuard {
public:
    LimitGuard(const std::string& path, const ImportOptions& options);
    ~LimitGuard();
    LimitGuard(const LimitGuard&) = delete;
    LimitGuard& operator=(const LimitGuard&) = delete;

    /// Whether an allocation failed: also one of which the importer made another error, or a file with less in it.
    [[nodiscard]] bool memory_ran_out() const;
    /// Throws CommandError (invalid_input) that names the limit.
    [[noreturn]] void refuse_memory() const;

private:
    void limit_memory();
    void limit_time(const ImportOptions& options);

    std::string path_;
    ImportLimits limits_;
    struct rlimit memory_before_ {};
    std::new_handler handler_before_ = nullptr;
    struct sigaction action_before_ {};
    struct itimerval timer_before_ {};
};

/// Half of the machine's memory: baking takes four times what importing takes, so that no larger file could be baked.
std::uint64_t default_import_memory();

}  // namespace espalier::tools
