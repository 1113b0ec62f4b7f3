// The closest hit of a ray over the instances of a scene.
#pragma once

#include <runtime/rays/queries.hpp>
#include <runtime/scenes/ray.hpp>

namespace espalier::detail {

/// Returns the closest hit of a mesh, for a ray in its local space and a filter.
using ClosestHitQuery = RayHit (*)(const BlobData& mesh, const Ray& local, const TriangleFilter& filter);

/// A search for the closest hit of a ray, which a walk takes to the instances of a scene.
class ClosestRay {
public:
    ClosestRay(const SceneData& scene, const SceneRay& ray, const SceneFilter& filter)
        : scene_(scene), ray_(ray), passage_(ray.passage(scene)), filter_(filter) {}

    [[nodiscard]] const SceneData& scene() const { return scene_; }
    [[nodiscard]] const Passage& passage() const { return passage_; }
    [[nodiscard]] std::uint32_t mask() const { return filter_.mask(); }
    /// Returns the limit of the walk before it has found a hit.
    [[nodiscard]] float limit() const { return passage_.key_of(ray_.world().t_max); }

    /// Searches an instance and lowers the limit of the walk.
    template <ClosestHitQuery closest_hit>
    ESPALIER_ALWAYS_INLINE Visit search(const VisitedInstance& instance, float& limit) {
        const FilterOfInstance keep = {filter_, instance};
        const auto query = [&](const auto& part, const auto&... local)
                               ESPALIER_ALWAYS_INLINE_LAMBDA { return hit_of<closest_hit>(keep, part, local...); };
        const InScene<RayHit> hit = ray_.query(instance, best_ ? limit_above(best_->t) : ray_.world().t_max, query);
        if (!best_.is_better(*hit, instance.id_of(hit.instance), &RayHit::t)) return Visit::next;
        best_.set(*hit, instance.id_of(hit.instance));
        limit = passage_.key_of(limit_above(hit->t));
        return Visit::next;
    }

    /// Returns the closest hit of all searched instances, in the world.
    [[nodiscard]] InScene<RayHit> result() const {
        InScene<RayHit> result = best_.result();
        if (result)
            result.hit.normal =
                normal_to_world(transform_at(scene_, InstanceId{result.instance.index}), result->normal);
        return result;
    }

private:
    template <ClosestHitQuery closest_hit>
    ESPALIER_ALWAYS_INLINE static InScene<RayHit> hit_of(const FilterOfInstance& keep, const Blob& mesh,
                                                         const Ray& local) {
        return {closest_hit(data_of(mesh), local, keep.of(mesh)), {}};
    }
    template <ClosestHitQuery>
    static InScene<RayHit> hit_of(const FilterOfInstance& keep, const Blob& mesh, const RoundedRay& local) {
        return {raycast(mesh, local, keep.of(mesh)), {}};
    }
    template <ClosestHitQuery, class... Local>
    static InScene<RayHit> hit_of(const FilterOfInstance& keep, const BakedScene& tile, const Local&... local) {
        return raycast(tile, local..., keep.of(tile));
    }

    const SceneData& scene_;
    const SceneRay& ray_;
    Passage passage_;
    const SceneFilter& filter_;
    BestInScene<RayHit> best_{QueryStatus::not_found};
};

/// A visitor of the instances of a search; the query is that of the walk's instruction set.
template <ClosestHitQuery closest_hit>
struct ClosestRayVisitor {
    ClosestRay& closest;

    ESPALIER_ALWAYS_INLINE Visit operator()(const VisitedInstance& instance, float& limit) const {
        return closest.search<closest_hit>(instance, limit);
    }
};

/// Searches the instances whose boxes the ray meets, the nearest first, by the best instruction set of this machine.
void search_by_best_set(ClosestRay& closest);

}  // namespace espalier::detail
