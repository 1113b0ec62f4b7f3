// Blobs and scenes that the command reads.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <espalier/blob.hpp>
#include <espalier/scene.hpp>

#include "base/exit_code.hpp"

namespace espalier::tools {

/// The whole file. Throws CommandError (file_access) when it cannot be read, (unsupported) when it is larger than any
/// blob.
std::vector<std::byte> read_file(const std::string& path);

/// Which exit code a refused blob has: newer than this program, or broken.
ExitCode exit_code_of(OpenStatus status);

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

/// A file, opened as a scene if it begins as one, else as a blob. Moved as one, never copied.
struct AssetFile {
    AssetFile() = default;
    /// Throws CommandError as read_file does. What was opened may be a refusal.
    explicit AssetFile(const std::string& file_path);
    AssetFile(AssetFile&&) = default;
    AssetFile& operator=(AssetFile&&) = default;

    [[nodiscard]] const BakedScene& scene() const { return parts.scene; }
    [[nodiscard]] OpenStatus status() const;
    /// Returns what was refused, why, and what to do.
    [[nodiscard]] std::string refusal() const;
    /// Throws CommandError (invalid_input or unsupported) for a refusal.
    void require_open() const;
    /// Returns whether there is no triangle, or no instance.
    [[nodiscard]] bool is_empty() const {
        return is_a_scene ? scene().instance_count() == 0 : blob.triangle_count() == 0;
    }

    std::string path;
    std::vector<std::byte> bytes;
    bool is_a_scene = false;
    Blob blob;
    SceneFile parts;  ///< of a scene
};

/// Opens a blob. Throws CommandError as read_file does, and (invalid_input or unsupported) for a refusal, and for a
/// scene.
AssetFile open_blob_file(const std::string& path);

/// Opens a scene that was just baked. Throws CommandError (internal) when the reader refuses it.
SceneFile opened_scene(const std::string& path, std::span<const std::byte> bytes);

}  // namespace espalier::tools
