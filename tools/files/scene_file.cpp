#include "scene_file.hpp"

#include <cstring>

#include "base/exit_code.hpp"
#include "base/numbers.hpp"
#include "blob_file.hpp"

namespace espalier::tools {

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
    throw CommandError(ExitCode::internal,
                       text("the scene baked for '", printable(path), "' is refused by this program's own reader: ",
                            describe(file.scene.status()), ". Nothing was written; please report the files."));
}

}  // namespace espalier::tools
