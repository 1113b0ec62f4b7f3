#include "output_names.hpp"

#include <cstring>
#include <filesystem>
#include <system_error>

#include "base/exit_code.hpp"
#include "base/numbers.hpp"
#include "output_file.hpp"
#include "platform/paths.hpp"
#include "platform/standard_streams.hpp"
#include "platform/written_file.hpp"

namespace espalier::tools {

namespace fs = std::filesystem;

[[noreturn]] void fail_to_write(const std::string& path, int error) {
    throw CommandError(ExitCode::file_access,
                       text("cannot write '", printable(path), "': ", std::strerror(error),
                            ". This file was not written; check the folder, its rights and the space on the disk."),
                       {.file = path});
}

void require_writable(std::span<const NamedOutput> outputs) {
    for (const NamedOutput& output : outputs) {
        if (output.path.empty()) continue;
        if (output.path == "-") {
            throw CommandError(ExitCode::usage, text(output.option, " -: an output needs the name of a file. ./- is a ",
                                                     "file of that name, /dev/stdout the standard output."));
        }
        std::error_code error;
        const fs::file_status status = fs::status(path_of(output.path), error);
        if (is_standard_output(output.path)) continue;
        if (!fs::exists(status) || fs::is_regular_file(status) || fs::is_directory(status)) {
            OutputFiles().add(output.path, {});  // a temporary that is removed again
            if (!fs::exists(status)) continue;
            if (const int failure = error_of_replacing(path_of(output.path)); failure != 0)
                fail_to_write(output.path, failure);
        } else if (const int failure = error_of_writing_to(output.path); failure != 0) {
            fail_to_write(output.path, failure);
        }
    }
}

void refuse_standard_output(std::span<const NamedOutput> outputs) {
    for (const NamedOutput& output : outputs) {
        if (output.path.empty() || !is_standard_output(output.path)) continue;
        throw CommandError(ExitCode::usage,
                           text(output.option, ' ', printable(output.path),
                                ": it is the standard output, where --json writes its document. Give another file."));
    }
}

void require_ending(const NamedOutput& output, std::string_view ending, std::string_view what) {
    std::error_code error;
    const fs::file_status status = fs::status(path_of(output.path), error);
    const bool is_device = is_standard_output(output.path) || (fs::exists(status) && !fs::is_regular_file(status));
    if (output.path.empty() || output.path.ends_with(ending) || is_device) return;
    throw CommandError(ExitCode::usage, text(output.option, ' ', printable(output.path), ": ", what,
                                             "; give it a name that ends in ", ending, '.'));
}

void refuse_to_overwrite_input(std::span<const NamedOutput> outputs, const std::string& input) {
    for (const NamedOutput& output : outputs) {
        std::error_code error;
        const fs::path path = path_of(output.path);
        if (!fs::equivalent(path, path_of(input), error) || error) continue;
        if (!fs::is_regular_file(path, error)) continue;
        throw CommandError(ExitCode::usage,
                           text("the output '", printable(output.path), "' is the input '", printable(input),
                                "' itself, which it would replace. Give another name to ", output.option, "."),
                           {.file = output.path});
    }
}

void refuse_one_file_for_two(std::span<const NamedOutput> outputs) {
    std::error_code error;
    const auto place = [&error](const std::string& path) {
        fs::path target;
        if (follow_links(path_of(path), target) != 0) target = path_of(path);  // which is refused elsewhere
        return fs::weakly_canonical(fs::absolute(target), error);
    };
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        for (const NamedOutput& other : outputs.first(i)) {
            const NamedOutput& output = outputs[i];
            if (output.path.empty() || other.path.empty()) continue;
            const fs::path path = path_of(output.path);
            if (place(output.path) != place(other.path) && !fs::equivalent(path, path_of(other.path), error)) continue;
            if (fs::exists(path, error) && !fs::is_regular_file(path, error)) continue;
            throw CommandError(ExitCode::usage,
                               text(output.option, " and ", other.option, " name the same file. Give each its own."));
        }
    }
}

}  // namespace espalier::tools
