// The interface of a system that casts rays at many instances of a few meshes.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <espalier/scene.hpp>

#include "../memory.hpp"
#include "../rays.hpp"

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

}  // namespace espalier::bench
