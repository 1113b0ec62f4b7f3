// A ray in a scene, in the world and in the local spaces of instances.
#pragma once

#include <espalier/advanced/rounding.hpp>
#include <espalier/scene.hpp>
#include <runtime/lattice/rounder.hpp>
#include <runtime/scenes/instance_walk.hpp>
#include <runtime/scenes/passage.hpp>
#include <runtime/transforms/local_shape.hpp>

namespace espalier::detail {

/// Returns whether to_local() may turn the direction by more than a rounding, because it takes coordinates below 2^-100
/// for zero, in the world and in local space.
inline bool is_tiny(const SceneData& scene, const Vec3& direction) {
    const float longest = maximum(maximum(absolute(direction.x), absolute(direction.y)), absolute(direction.z));
    return longest < 0x1p-70f * maximum(scene.largest_scale, 1.0f);
}

/// Returns the longest way along an axis from a point to an end of a region.
inline float reach_of(const Lattice& region, const Vec3& point) {
    const float step = power_of_two(region.step_exponent);
    const float from[3] = {region.origin.x - point.x, region.origin.y - point.y, region.origin.z - point.z};
    float reach = 0.0f;
    for (int k = 0; k < 3; ++k) {
        const float to = from[k] + static_cast<float>(region.extent[k]) * step;
        reach = maximum(maximum(absolute(from[k]), absolute(to)), reach);
    }
    return reach;
}

/// A ray in the world, which each instance is given in its local space: rounded for a region, or for itself.
class SceneRay {
public:
    explicit SceneRay(const Ray& world) : world_(world) {}
    /// A ray that is also rounded for a region.
    SceneRay(const Ray& world, const RoundedRay& rounded, const Lattice& region)
        : world_(world), rounded_(&rounded), region_(&region) {}

    [[nodiscard]] const Ray& world() const { return world_; }
    /// Returns the boxes of instances that the ray meets, also if it is rounded for a region that is larger than the
    /// scene.
    [[nodiscard]] Passage passage(const SceneData& scene) const {
        if (is_tiny(scene, world_.direction))
            return {scene, ShapeBounds{world_.origin, {}, {infinity, infinity, infinity}}};
        const float reach = region_ != nullptr ? reach_of(*region_, world_.origin) : 0.0f;
        return {scene, ShapeBounds{world_.origin, {}, {}}, world_.direction, reach};
    }

    /// Returns what a query of the instance returns for the ray in local space, up to t_max. The query takes a Blob and
    /// a Ray or a RoundedRay, or a BakedScene and a Ray with or without a RoundedRay.
    template <class Query>
    ESPALIER_ALWAYS_INLINE auto query(const VisitedInstance& instance, float t_max, Query query) const {
        if (instance.mesh == nullptr) return query_tile(instance, t_max, query);
        if (region_ != nullptr && !instance.is_rounded && lies_in(*region_, *instance.mesh, instance.transform))
            return query_on_lattice(instance, t_max, query);
        return query(*instance.mesh, local(instance, t_max));
    }

private:
    [[nodiscard]] ESPALIER_ALWAYS_INLINE Ray local(const VisitedInstance& instance, float t_max) const {
        Ray ray = local_ray(instance.transform, world_);
        ray.t_max = minimum(t_max, ray.t_max);
        return ray;
    }
    // Each kind of instance has a frame of its own: the stack is that of one of them.
    template <class Query>
    ESPALIER_NOINLINE auto query_on_lattice(const VisitedInstance& instance, float t_max, Query query) const {
        RoundedRay local = to_local(instance.transform, *rounded_);
        shorten(local, t_max);
        return query(*instance.mesh, local);
    }
    template <class Query>
    ESPALIER_NOINLINE auto query_tile(const VisitedInstance& instance, float t_max, Query query) const {
        const Ray local = this->local(instance, t_max);
        if (region_ == nullptr || instance.is_rounded || !lies_in(*region_, *instance.tile, instance.transform))
            return query(*instance.tile, local);
        return query(*instance.tile, local, to_local(instance.transform, *rounded_));
    }

    const Ray& world_;
    const RoundedRay* rounded_ = nullptr;  ///< null, or the ray rounded for the region
    const Lattice* region_ = nullptr;
};

/// Returns what a query returns for a ray that is rounded for the common lattice of a scene.
template <class Query>
ESPALIER_NOINLINE auto with_ray_on_common_lattice(const SceneData& scene, const Ray& world, Query query) {
    const RoundedRay rounded = round_ray(scene.common, world);
    return query(SceneRay(world, rounded, scene.common));
}
/// Returns what a query returns for a ray in a scene. The query takes a SceneRay.
template <class Query>
auto with_scene_ray(const SceneView& scene, const Ray& world, Query query) {
    if (!data_of(scene).has_common) return query(SceneRay(world));
    return with_ray_on_common_lattice(data_of(scene), world, query);
}
/// Returns the same for a ray that the caller has rounded.
template <class Query>
auto with_scene_ray(const Ray& world, const RoundedRay& rounded, Query query) {
    const Lattice& region = rounded.data().region;
    return query(is_region(region) ? SceneRay(world, rounded, region) : SceneRay(world));
}

}  // namespace espalier::detail
