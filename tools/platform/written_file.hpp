// Bytes to files: temporaries that take the place of a file, and what is written where it is. Errors are values of
// errno.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace espalier::tools {

/// Stores in `target` the file that a path names behind symbolic links. Returns 0 or an error.
int follow_links(const std::filesystem::path& path, std::filesystem::path& target);

/// Writes a new file in the folder of `target`, flushes it to the disk and stores its name in `temporary`. Returns 0,
/// or an error; then no file is left behind and `temporary` is empty.
int write_temporary(const std::filesystem::path& target, std::span<const std::byte> bytes,
                    std::filesystem::path& temporary);

/// Renames the temporary to `target`, which it replaces at once. Returns 0 or an error.
int replace_file(const std::filesystem::path& target, const std::filesystem::path& temporary);

/// Writes to a pipe or a device, or to the standard output where the path names it. Returns 0 or an error.
int write_directly(const std::string& path, std::span<const std::byte> bytes);

/// Returns 0 if this process may write to the pipe or device, else an error.
int error_of_writing_to(const std::string& path);

/// Returns 0 if another file may take the place of this one, as far as can be found before; else an error.
int error_of_replacing(const std::filesystem::path& target);

/// While it lives, an interrupt of the process waits, so that it leaves no temporary behind.
class HeldInterrupts {
public:
    HeldInterrupts();
    ~HeldInterrupts();
    HeldInterrupts(const HeldInterrupts&) = delete;
    HeldInterrupts& operator=(const HeldInterrupts&) = delete;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace espalier::tools
