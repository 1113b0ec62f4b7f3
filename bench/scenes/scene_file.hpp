// Scenes that are read from files, for systems that place meshes themselves.
#pragma once

#include <string>
#include <vector>

#include "scene_system.hpp"

namespace espalier::bench {

/// A baked scene without tiles, with the triangles of its meshes as they are baked.
struct SceneFile {
    std::vector<std::byte> bytes;
    Placed placed;

    /// Throws std::runtime_error where the file is no such scene.
    explicit SceneFile(const std::string& path);

    /// Returns all triangles of all instances in the world.
    [[nodiscard]] Mesh flattened() const;
};

}  // namespace espalier::bench
