// The loop over all instances of a scene, in public calls: what every query of a scene must equal, bit for bit.
#pragma once

#include <cstdint>

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

/// Compares the closest hit, any hit and all hits.
SceneComparison compare_rays(const BakedScene& scene, const Ray& ray, const SceneFilter& filter = {});
SceneComparison compare_closest_points(const BakedScene& scene, const Vec3& point, float max_distance,
                                       std::uint32_t mask = 0xFFFFFFFF);
/// Compares whether anything overlaps, and what does. Shape is any SceneShape.
template <class Shape>
SceneComparison compare_overlaps(const BakedScene& scene, const Shape& shape, const SceneFilter& filter = {});
/// Shape is Sphere or Capsule.
template <class Shape>
SceneComparison compare_sweeps(const BakedScene& scene, const Shape& shape, const Vec3& displacement,
                               const SceneFilter& filter = {});

}  // namespace espalier::tests
