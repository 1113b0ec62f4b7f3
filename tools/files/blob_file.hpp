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

/// An opened blob with the bytes that it points into: moved as one, never copied.
struct BlobFile {
    std::vector<std::byte> bytes;
    Blob blob;

    BlobFile() = default;
    BlobFile(BlobFile&&) = default;
    BlobFile& operator=(BlobFile&&) = default;
};

/// Throws CommandError as read_file does, and (invalid_input or unsupported) when `open` refuses the bytes.
BlobFile open_blob_file(const std::string& path);

/// Opens the blob that was read from `path`. Throws CommandError as open_blob_file does, and (unsupported) for a scene.
BlobFile open_blob(const std::string& path, std::vector<std::byte> bytes);

/// Which exit code a refused blob has: newer than this program, or broken.
ExitCode exit_code_of(OpenStatus status);

/// What was refused, why, and what to do.
std::string refusal_text(const std::string& path, OpenStatus status);

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
