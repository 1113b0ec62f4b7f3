// Results to files: checked before a verb starts, so that a long bake does not end with a name that is none, and
// written so that a file is either the whole new one or untouched.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <import/platform/process.hpp>

#include "base/exit_code.hpp"

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
    Guard held_ = hold_interrupts();
    std::vector<Staged> staged_;
};

/// Writes one file as OutputFiles does.
void write_output_file(const std::string& path, std::span<const std::byte> bytes);

/// As write_output_file, but a file that has these bytes already keeps its time: nobody who reads it is built again.
void write_output_file_if_changed(const std::string& path, std::span<const std::byte> bytes);

/// Returns one rule: `target` is made again when one of `sources` changes. Throws CommandError (unsupported) for a path
/// that this syntax cannot express.
std::string depfile_text(const std::string& target, std::span<const std::string> sources);

/// A file to be written and the option that names it; an empty path is none.
struct NamedOutput {
    const char* option;
    const std::string& path;
};

/// Throws CommandError (usage) when an output is the file `input`, which it would replace. An empty `input` is none.
void refuse_to_overwrite_input(std::span<const NamedOutput> outputs, const std::string& input);

/// Throws CommandError (file_access) when an output cannot be created in its folder, and (usage) for the name "-". An
/// empty path is no output.
void require_writable(std::span<const NamedOutput> outputs);

/// Throws CommandError (usage) for an output that is the standard output, which has no room for a document as well.
void refuse_standard_output(std::span<const NamedOutput> outputs);

/// Throws CommandError (usage) unless the path ends in `ending`, or is empty, or no regular file. `what` is written
/// there.
void require_ending(const NamedOutput& output, std::string_view ending, std::string_view what);

/// Throws CommandError (file_access).
[[noreturn]] void fail_to_write(const std::string& path, int error);

/// Throws CommandError (usage) when two of the outputs are one file, of which the last would stay.
void refuse_one_file_for_two(std::span<const NamedOutput> outputs);

}  // namespace espalier::tools
