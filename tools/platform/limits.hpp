// Limits on the memory and the processor time of this process. Errors are values of errno.
#pragma once

#include <cstdint>
#include <memory>

namespace espalier::tools {

/// While it lives, the process can add so much memory and no more: an allocation beyond it fails. 0 is no limit. One at
/// a time.
class MemoryLimit {
public:
    explicit MemoryLimit(std::uint64_t added_bytes);
    ~MemoryLimit();
    MemoryLimit(const MemoryLimit&) = delete;
    MemoryLimit& operator=(const MemoryLimit&) = delete;

    /// Returns 0, or the error for which there is no limit.
    [[nodiscard]] int error() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// While it lives, `handler` is called after so much processor time of the process, user and system: anywhere, so that
/// it may neither allocate nor lock. 0 is no limit. One at a time.
class ProcessorTimeLimit {
public:
    ProcessorTimeLimit(double seconds, void (*handler)());
    ~ProcessorTimeLimit();
    ProcessorTimeLimit(const ProcessorTimeLimit&) = delete;
    ProcessorTimeLimit& operator=(const ProcessorTimeLimit&) = delete;

    /// Returns 0, or the error for which there is no limit.
    [[nodiscard]] int error() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Tests whether systems of this kind can limit the memory of a process.
bool can_limit_memory();

/// Returns the bytes of memory that the machine has.
std::uint64_t machine_memory();

}  // namespace espalier::tools
