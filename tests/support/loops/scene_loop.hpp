// The loop over all instances of a scene, in public calls: what every query of a scene must equal, bit for bit.
#pragma once

#include <cstdint>

#include <espalier/scenes/moving_scene.hpp>
#include <espalier/scene.hpp>

namespace espalier::tests {

/// A query of a scene, compared with the loop.
///
/// Where an instance refuses, the loop passes it over, and the scene may refuse the query. An answer of the scene is
/// that of the loop in any case.
struct SceneComparison {
    const char* fault = nullptr;  ///< what differs; null if nothing does
    bool is_found = false;        ///< the scene has found something
};

/// An instance of a moving scene by its slot, as one of a baked scene by its number: not found where a slot is free.
Result<Instance> instance_of_number(const BakedScene& scene, std::uint32_t number);
Result<Instance> instance_of_number(const MovingScene& scene, std::uint32_t number);

/// Compares the closest hit, any hit and all hits. Scene is BakedScene or MovingScene, as below.
template <class Scene>
SceneComparison compare_rays(const Scene& scene, const Ray& ray, const SceneFilter& filter = {});
template <class Scene>
SceneComparison compare_closest_points(const Scene& scene, const Vec3& point, float max_distance,
                                       std::uint32_t mask = 0xFFFFFFFF);
/// Compares whether anything overlaps, and what does. Shape is any SceneShape.
template <class Scene, class Shape>
SceneComparison compare_overlaps(const Scene& scene, const Shape& shape, const SceneFilter& filter = {});
/// Shape is any SweptShape. In the loop, a first sweep of each instance finds the contact and a second one the skin.
template <class Scene, class Shape>
SceneComparison compare_sweeps(const Scene& scene, const Shape& shape, const Vec3& displacement,
                               const SceneSweepOptions& options = {});
/// Body is any that find_contacts() takes.
template <class Scene, class Body>
SceneComparison compare_contacts(const Scene& scene, const Body& body, float margin, std::size_t places,
                                 const SceneFilter& filter = {});

}  // namespace espalier::tests
