// The files that a verb is to write, checked before it starts: a long bake does not end with a name that is none.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace espalier::tools {

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
