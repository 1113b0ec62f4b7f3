#include "outputs.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include <import/platform/files.hpp>

#include "base/exit_code.hpp"

namespace espalier::tools {

namespace {

/// As compilers write them: a space gets a backslash, and those before it double; a dollar doubles.
std::string escaped_for_make(const std::string& path) {
    std::string result;
    std::size_t backslashes = 0;
    for (const char character : path) {
        if (character == '\n' || character == '\r') {
            throw_error(ExitCode::unsupported, "'", printable(path),
                        "': a name with a line break cannot be written to a depfile. Rename the file.");
        }
        if (character == ' ' || character == '\t') result.append(backslashes + 1, '\\');
        if (character == '#') result += '\\';
        if (character == '$') result += '$';
        result += character;
        backslashes = character == '\\' ? backslashes + 1 : 0;
    }
    return result;
}

}  // namespace

OutputFiles::~OutputFiles() {
    std::error_code error;
    for (const Staged& file : staged_)
        if (!file.temporary.empty()) std::filesystem::remove(file.temporary, error);
}

void OutputFiles::add(const std::string& path, std::span<const std::byte> bytes) {
    std::error_code error;
    const std::filesystem::path named = path_of(path);
    const auto status = std::filesystem::status(named, error);
    if (std::filesystem::is_directory(status)) fail_to_write(path, EISDIR);
    Staged file{path, {}, {}, {}};
    if (is_standard_output(path) || (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))) {
        file.bytes = bytes;
    } else {
        if (const int failure = follow_links(named, file.target); failure != 0) fail_to_write(path, failure);
        if (const int failure = write_temporary(file.target, bytes, file.temporary); failure != 0)
            fail_to_write(path, failure);
    }
    staged_.push_back(std::move(file));
}

void OutputFiles::commit() {
    for (Staged& file : staged_) {
        if (file.temporary.empty()) {
            if (const int failure = write_directly(file.path, file.bytes); failure != 0)
                fail_to_write(file.path, failure);
            continue;
        }
        if (const int failure = replace_file(file.target, file.temporary); failure != 0)
            fail_to_write(file.path, failure);
        file.temporary.clear();
    }
    staged_.clear();
}

void write_output_file(const std::string& path, std::span<const std::byte> bytes) {
    OutputFiles files;
    files.add(path, bytes);
    files.commit();
}

void write_output_file_if_changed(const std::string& path, std::span<const std::byte> bytes) {
    std::error_code error;
    if (std::filesystem::is_regular_file(path_of(path), error) && !is_standard_output(path)) {
        std::vector<std::byte> before;
        if (read_whole_file(path_of(path), before) == 0 && std::ranges::equal(bytes, before)) return;
    }
    write_output_file(path, bytes);
}

std::string depfile_text(const std::string& target, std::span<const std::string> sources) {
    std::string result = escaped_for_make(target) + ':';
    for (const std::string& source : sources) result += " \\\n " + escaped_for_make(source);
    result += '\n';
    return result;
}

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
            throw_error(ExitCode::usage, output.option, " -: an output needs the name of a file. ./- is a ",
                        "file of that name, /dev/stdout the standard output.");
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
        throw_error(ExitCode::usage, output.option, ' ', printable(output.path),
                    ": it is the standard output, where --json writes its document. Give another file.");
    }
}

void require_ending(const NamedOutput& output, std::string_view ending, std::string_view what) {
    std::error_code error;
    const fs::file_status status = fs::status(path_of(output.path), error);
    const bool is_device = is_standard_output(output.path) || (fs::exists(status) && !fs::is_regular_file(status));
    if (output.path.empty() || output.path.ends_with(ending) || is_device) return;
    throw_error(ExitCode::usage, output.option, ' ', printable(output.path), ": ", what,
                "; give it a name that ends in ", ending, '.');
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
            throw_error(ExitCode::usage, output.option, " and ", other.option,
                        " name the same file. Give each its own.");
        }
    }
}

}  // namespace espalier::tools
