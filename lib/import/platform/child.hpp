// A copy of this process that works apart from it and sends bytes back: where it crashes, this process goes on.
#pragma once

#include <cstddef>
#include <cstdio>
#include <functional>
#include <span>

namespace espalier::importer {

/// How a child ended: by an exit status or by a signal. Both are 0 after a good end, and where another part of the
/// program has fetched the status.
struct ChildEnd {
    int exit_status = 0;
    int signal = 0;
};

class ChildProcess {
public:
    /// Makes the child, in which `work` writes to a stream; its value is the exit status. Signals have their default
    /// actions there, and nothing of the program is ended properly: no destructor, no buffer of a stream.
    explicit ChildProcess(const std::function<int(std::FILE* to_parent)>& work);
    /// Ends the child, unless it has ended.
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Returns 0, or the value of errno for which there is no child: ENOSYS where the system cannot copy processes.
    [[nodiscard]] int error() const { return error_; }
    /// Reads the next bytes that the child writes. Returns fewer than there is room for at their end.
    std::size_t read(std::span<std::byte> bytes);
    /// Waits for the end of the child.
    ChildEnd wait();

private:
    int error_ = 0;
    long id_ = -1;
    std::FILE* from_child_ = nullptr;
};

}  // namespace espalier::importer
