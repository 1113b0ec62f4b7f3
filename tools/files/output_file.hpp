// Writing results so that a file is either the whole new one or untouched.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "platform/written_file.hpp"

namespace espalier::tools {

/// The results of one verb. All are written under temporary names before the first is renamed, so that a full disk or
/// an interrupt leaves no new file beside old ones.
class OutputFiles {
public:
    OutputFiles() = default;
    /// Removes what was not renamed.
    ~OutputFiles();
    OutputFiles(const OutputFiles&) = delete;
    OutputFiles& operator=(const OutputFiles&) = delete;

    /// Writes a temporary beside `path` and flushes it to the disk. A link is followed. The standard output and
    /// what is no regular file (a pipe, /dev/null) are written to by commit(), up to which the bytes must live. Throws
    /// CommandError (file_access).
    void add(const std::string& path, std::span<const std::byte> bytes);
    /// Renames the temporaries in the order of add(). Throws CommandError (file_access).
    void commit();

private:
    struct Staged {
        std::string path;
        std::filesystem::path target;
        std::filesystem::path temporary;   ///< empty: written directly
        std::span<const std::byte> bytes;  ///< of a direct one
    };
    HeldInterrupts held_;
    std::vector<Staged> staged_;
};

/// Writes one file as OutputFiles does.
void write_output_file(const std::string& path, std::span<const std::byte> bytes);

/// As write_output_file, but a file that has these bytes already keeps its time: nobody who reads it is built again.
void write_output_file_if_changed(const std::string& path, std::span<const std::byte> bytes);

/// Returns one rule: `target` is made again when one of `sources` changes. Throws CommandError (unsupported) for a path
/// that this syntax cannot express.
std::string depfile_text(const std::string& target, std::span<const std::string> sources);

}  // namespace espalier::tools
