#include "blob_file.hpp"

#include <cstdint>
#include <cstring>
#include <limits>

#include <import/base/git_lfs.hpp>
#include <import/platform/files.hpp>

namespace espalier::tools {

namespace {

constexpr std::size_t largest_blob = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t chunk = std::size_t{1} << 20;

std::string_view begin_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

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

AssetFile::AssetFile(const std::string& file_path)
    : path(file_path), bytes(read_file(path)), is_a_scene(is_scene(bytes)) {
    if (is_a_scene) parts = try_open_scene(bytes);
    else blob = open(bytes);
}

OpenStatus AssetFile::status() const {
    if (is_a_scene) return scene().status();
    constexpr std::string_view magic = "ESPL";
    // A blob that was cut off within its header still begins as one.
    const bool begins_as_one = begin_of(bytes).starts_with(magic.substr(0, bytes.size()));
    return blob.status() == OpenStatus::too_short && !begins_as_one ? OpenStatus::not_a_blob : blob.status();
}

std::string AssetFile::refusal() const {
    if (is_git_lfs_pointer(begin_of(bytes))) return words_for_git_lfs_pointer(path);
    const auto refused = [&](const char* advice) {
        return text("'", printable(path), "' is refused: ", describe(status()), " (status ", static_cast<int>(status()),
                    ").", advice);
    };
    if (status() == OpenStatus::unsupported_version) return refused("");  // whose description has advice
    if (status() == OpenStatus::not_a_blob) return refused(" A mesh is made into a blob by 'espalier bake'.");
    return refused(exit_code_of(status()) == ExitCode::unsupported
                       ? " Use a newer espalier, or bake it again with this one."
                       : " Bake it again, or fetch it again.");
}

void AssetFile::require_open() const {
    if (status() == OpenStatus::ok) return;
    throw CommandError(exit_code_of(status()), refusal(), {.file = path});
}

AssetFile open_blob_file(const std::string& path) {
    AssetFile file(path);
    if (file.is_a_scene)
        throw_file_error(ExitCode::unsupported, path,
                         " is a scene, and a blob is needed here. Bake one without --instances.");
    file.require_open();
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
