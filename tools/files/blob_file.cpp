#include "blob_file.hpp"

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <limits>
#include <utility>

#include "base/numbers.hpp"
#include "platform/paths.hpp"
#include "scene_file.hpp"

namespace espalier::tools {

namespace {

constexpr std::size_t largest_blob = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t chunk = std::size_t{1} << 20;

[[noreturn]] void fail_to_read(const std::string& path, int error) {
    throw CommandError(
        ExitCode::file_access,
        text("cannot read '", printable(path), "': ", std::strerror(error), ". Check the path and the rights on it."),
        {.file = path});
}

}  // namespace

// In chunks and not by the file's stated size: pipes and devices state none.
std::vector<std::byte> read_file(const std::string& path) {
    errno = 0;
    std::ifstream file;
    if (path != "-") file.open(path_of(path), std::ios::binary);
    std::istream& input = path == "-" ? std::cin : file;
    std::vector<std::byte> bytes;
    while (input) {
        const std::size_t have = bytes.size();
        if (have > largest_blob) {
            throw CommandError(ExitCode::unsupported,
                               text("'", printable(path), "' is larger than 4 GiB, which no blob is."), {.file = path});
        }
        bytes.resize(have + chunk);
        input.read(reinterpret_cast<char*>(bytes.data() + have), static_cast<std::streamsize>(chunk));
        bytes.resize(have + static_cast<std::size_t>(input.gcount()));
    }
    const bool failed = !input.eof() || input.bad() || (path == "-" && std::ferror(stdin) != 0);
    if (failed) fail_to_read(path, errno == 0 ? EIO : errno);
    return bytes;
}

ExitCode exit_code_of(OpenStatus status) {
    switch (status) {
        case OpenStatus::ok:
            return ExitCode::ok;
        case OpenStatus::unsupported_version:
        case OpenStatus::unsupported_profile:
        case OpenStatus::unsupported_feature:
            return ExitCode::unsupported;
        default:
            return ExitCode::invalid_input;
    }
}

std::string refusal_text(const std::string& path, OpenStatus status) {
    const char* advice = exit_code_of(status) == ExitCode::unsupported
                             ? "Use a newer espalier, or bake it again with this one."
                         : status == OpenStatus::not_a_blob ? "A mesh is made into a blob by 'espalier bake'."
                                                            : "Bake it again, or fetch it again.";
    return text("'", printable(path), "' is refused: ", describe(status), " (status ", static_cast<int>(status), "). ",
                advice);
}

BlobFile open_blob_file(const std::string& path) { return open_blob(path, read_file(path)); }

BlobFile open_blob(const std::string& path, std::vector<std::byte> bytes) {
    if (is_scene(bytes)) {
        throw CommandError(
            ExitCode::unsupported,
            text("'", printable(path), "' is a scene, and a blob is needed here. Bake one without --instances."),
            {.file = path});
    }
    BlobFile file;
    file.bytes = std::move(bytes);
    file.blob = open(file.bytes);
    const OpenStatus status = file.blob.status();
    if (status != OpenStatus::ok) throw CommandError(exit_code_of(status), refusal_text(path, status), {.file = path});
    return file;
}

}  // namespace espalier::tools
