// A scene as a file.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <espalier/scene.hpp>

namespace espalier::tools {

/// An opened scene, its meshes and its tiles. It refers to the bytes, which must outlive it: moved as one, never
/// copied.
struct SceneFile {
    std::vector<Blob> meshes;
    std::vector<BakedScene> tiles;
    BakedScene scene;

    SceneFile() = default;
    SceneFile(SceneFile&&) = default;
    SceneFile& operator=(SceneFile&&) = default;
};

/// Returns whether bytes begin as those of a scene.
bool is_scene(std::span<const std::byte> bytes);

/// Opens the scene, whose status may be a refusal.
SceneFile try_open_scene(std::span<const std::byte> bytes);

/// Opens the scene that was read from `path`. Throws CommandError (invalid_input or unsupported) when it is refused.
SceneFile open_scene_file(const std::string& path, std::span<const std::byte> bytes);

/// Opens a scene that was just baked. Throws CommandError (internal) when the reader refuses it.
SceneFile opened_scene(const std::string& path, std::span<const std::byte> bytes);

}  // namespace espalier::tools
