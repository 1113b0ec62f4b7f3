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

/// Throws CommandError (usage) when `output` is one of our own inputs, which it would replace. An empty `output` is
/// none.
void refuse_to_overwrite_input(const std::string& output, const std::string& input);

/// Throws CommandError (usage) when `output`, of -o, and what `option` names are one file, of which the last would
/// stay.
void refuse_one_file_for_two(const std::string& output, const char* option, const std::string& other);

}  // namespace espalier::tools
