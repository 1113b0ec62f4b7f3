// Writing results so that a file is either the whole new one or untouched.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace espalier::tools {

/// Writes a temporary beside `path`, flushes it to the disk, and renames it over `path`; on failure nothing is left
/// behind. A link is followed; what is no regular file (a pipe, /dev/null) is written to directly. Throws CommandError
/// (file_access).
void write_output_file(const std::string& path, std::span<const std::byte> bytes);

/// As write_output_file, but a file that has these bytes already keeps its time: nobody who reads it is built again.
void write_output_file_if_changed(const std::string& path, std::span<const std::byte> bytes);

/// A file to be written and the option that names it; an empty path is none.
struct NamedOutput {
    const char* option;
    const std::string& path;
};

/// Throws CommandError (usage) when an output is the file `input`, which it would replace. An empty `input` is none.
void refuse_to_overwrite_input(std::span<const NamedOutput> outputs, const std::string& input);

/// Throws CommandError (usage) when two of the outputs are one file, of which the last would stay.
void refuse_one_file_for_two(std::span<const NamedOutput> outputs);

}  // namespace espalier::tools
