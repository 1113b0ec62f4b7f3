// The interface of a system that casts rays at many instances of a few meshes.
#pragma once

#include "../memory.hpp"

namespace espalier::bench {

/// Meshes and their places in the world.
struct Placed {
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
};

class SceneSystem {
public:
    virtual ~SceneSystem() = default;
    /// Writes t of the closest hit of each ray; infinity for none.
    virtual void closest(const std::vector<Ray>& rays, std::vector<float>& hits) = 0;
    /// Returns the bytes of geometry and trees.
    [[nodiscard]] virtual std::size_t bytes() const = 0;

    static constexpr float miss = std::numeric_limits<float>::infinity();
};

struct SceneMaker {
    std::string system;
    std::string profile;
    std::function<std::unique_ptr<SceneSystem>(const Placed&)> make;
};

std::vector<SceneMaker> espalier_scene_makers();
/// Returns the makers of a scene that is baked already, whatever they are given.
std::vector<SceneMaker> baked_scene_makers(const std::vector<std::byte>& scene);
std::vector<SceneMaker> embree_scene_makers();

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
