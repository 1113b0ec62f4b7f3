#include "output_file.hpp"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/exit_code.hpp"
#include "base/numbers.hpp"
#include "output_names.hpp"
#include "platform/input_file.hpp"
#include "platform/paths.hpp"
#include "platform/standard_streams.hpp"

namespace espalier::tools {

namespace {

/// As compilers write them: a space gets a backslash, and those before it double; a dollar doubles.
std::string escaped_for_make(const std::string& path) {
    std::string result;
    std::size_t backslashes = 0;
    for (const char character : path) {
        if (character == '\n' || character == '\r') {
            throw CommandError(ExitCode::unsupported,
                               text("'", printable(path),
                                    "': a name with a line break cannot be written to a depfile. Rename the file."));
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

}  // namespace espalier::tools
