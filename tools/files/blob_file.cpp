#include "blob_file.hpp"

#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <utility>

#include "base/exit_code.hpp"
#include "base/numbers.hpp"
#include "platform/files.hpp"

namespace espalier::tools {

namespace {

constexpr std::size_t largest_blob = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t chunk = std::size_t{1} << 20;

}  // namespace

// In chunks and not by the file's stated size: pipes and devices state none.
std::vector<std::byte> read_file(const std::string& path) {
    InputFile file = path == "-" ? InputFile() : InputFile(path_of(path));
    std::vector<std::byte> bytes;
    for (std::size_t count = chunk; count == chunk;) {
        const std::size_t have = bytes.size();
        if (have > largest_blob) {
            throw_file_error(ExitCode::unsupported, path, " is larger than 4 GiB, which no blob is.");
        }
        bytes.resize(have + chunk);
        count = file.read(std::span(bytes).subspan(have));
        bytes.resize(have + count);
    }
    if (file.error() != 0) fail_to_read(path, file.error());
    return bytes;
}

ExitCode exit_code_of(OpenStatus status) {
    if (status == OpenStatus::ok) return ExitCode::ok;
    const bool is_newer = status == OpenStatus::unsupported_version || status == OpenStatus::unsupported_profile ||
                          status == OpenStatus::unsupported_feature;
    return is_newer ? ExitCode::unsupported : ExitCode::invalid_input;
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
        throw_file_error(ExitCode::unsupported, path,
                         " is a scene, and a blob is needed here. Bake one without --instances.");
    }
    BlobFile file;
    file.bytes = std::move(bytes);
    file.blob = open(file.bytes);
    const OpenStatus status = file.blob.status();
    if (status != OpenStatus::ok) throw CommandError(exit_code_of(status), refusal_text(path, status), {.file = path});
    return file;
}

bool is_scene(std::span<const std::byte> bytes) {
    constexpr char magic[] = {'E', 'S', 'P', 'S'};
    return bytes.size() >= sizeof(magic) && std::memcmp(bytes.data(), magic, sizeof(magic)) == 0;
}

SceneFile try_open_scene(std::span<const std::byte> bytes) {
    SceneFile file;
    file.meshes.resize(mesh_count_of_scene(bytes));
    file.tiles.resize(tile_count_of_scene(bytes));
    file.scene = open_scene(bytes, file.meshes, file.tiles);
    return file;
}

SceneFile open_scene_file(const std::string& path, std::span<const std::byte> bytes) {
    SceneFile file = try_open_scene(bytes);
    const OpenStatus status = file.scene.status();
    if (status != OpenStatus::ok) throw CommandError(exit_code_of(status), refusal_text(path, status), {.file = path});
    return file;
}

SceneFile opened_scene(const std::string& path, std::span<const std::byte> bytes) {
    SceneFile file = try_open_scene(bytes);
    if (file.scene) return file;
    throw_error(ExitCode::internal, "the scene baked for '", printable(path),
                "' is refused by this program's own reader: ", describe(file.scene.status()),
                ". Nothing was written; please report the files.");
}

}  // namespace espalier::tools
