// Systems that cast rays at many instances of a few meshes.
#pragma once

#include "../peers/contest.hpp"

namespace espalier::bench {

/// Meshes and their places in the world.
struct Placed {
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;  ///< none: the first mesh alone
};

/// A ray's answer is t of the closest hit, infinity for none. Bytes are those of geometry and trees.
using SceneContest = Contest<Ray, float>;

void add_espalier_scenes(const Placed& placed, SceneContest& to);
/// Adds a scene that is baked already.
void add_baked_scene(const std::vector<std::byte>& scene, SceneContest& to);
void add_embree_scene(const Placed& placed, SceneContest& to);  ///< where Embree is installed

// Scenes that are read from files, for systems that place meshes themselves.

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
