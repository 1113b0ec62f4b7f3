// Rays against all instances of a scene.
#include <type_traits>

#include <espalier/advanced/rounding.hpp>
#include <espalier/scene.hpp>
#include <runtime/lattice/rounder.hpp>
#include <runtime/rays/queries.hpp>
#include <runtime/scenes/closest_ray.hpp>
#include <runtime/scenes/instance_walk.hpp>
#include <runtime/scenes/passage.hpp>
#include <runtime/scenes/ray.hpp>

namespace espalier {

using namespace detail;

namespace {

/// Returns ok if the ray must be walked, else the status of the query. `rounding` is the status of a ray that the
/// caller has rounded.
QueryStatus status_without_walk(const SceneView& scene, const Ray& ray, QueryStatus rounding) {
    if (!scene) return refusal_of(scene);
    if (rounding != QueryStatus::ok) return rounding;
    // Which origins are out of range depends on the lattices of the instances.
    const QueryStatus status = refusal_or_miss(data_of(scene).tree, ray);
    if (status == QueryStatus::invalid_argument) return status;
    // The window, by its bits: subnormal numbers are compared alike in every mode.
    const bool starts_before = is_negative(ray.t_min) || magnitude_bits(ray.t_min) <= magnitude_bits(ray.t_max);
    return is_radius(ray.t_max) && starts_before ? QueryStatus::ok : QueryStatus::not_found;
}

InScene<RayHit> cast(const SceneView& scene, const SceneRay& ray, const SceneFilter& filter,
                     QueryStatus rounding = QueryStatus::ok) {
    const QueryStatus status = status_without_walk(scene, ray.world(), rounding);
    if (status != QueryStatus::ok) return BestInScene<RayHit>(status).result();
    const SceneData& data = data_of(scene);
    ClosestRay closest(data, ray, filter);
    if (small_code || data.moving != nullptr) {  // one walk for all visitors
        const ClosestRayVisitor<single_rays::closest_hit> visit = {closest};
        visit_nearest_instances(data, filter.mask(), closest.passage(), closest.limit(), visit);
    } else if (data.instance_count != 0) {
        search_by_best_set(closest);
    }
    return closest.result();
}

YesNo test(const SceneView& scene, const SceneRay& ray, const SceneFilter& filter,
           QueryStatus rounding = QueryStatus::ok) {
    const QueryStatus status = status_without_walk(scene, ray.world(), rounding);
    if (status != QueryStatus::ok) return YesNo(status);
    const SceneData& data = data_of(scene);
    const float t_max = ray.world().t_max;
    const Passage passage = ray.passage(data);
    QueryStatus refusal = QueryStatus::not_found;
    const auto visit = [&](const VisitedInstance& instance, float&) {
        const FilterOfInstance keep = {filter, instance};
        const YesNo answer = ray.query(instance, t_max, [&](const auto& part, const auto&... local) {
            return occluded(part, local..., keep.of(part));
        });
        if (is_refused(answer.status())) refusal = status_in_scene(answer.status());
        return answer.yes() ? Visit::stop : Visit::next;
    };
    const Visit end = visit_instances(data, filter.mask(), passage, passage.key_of(t_max), visit);
    return YesNo(end == Visit::stop ? QueryStatus::ok : refusal);
}

/// A visitor of the hits of one instance, which it passes on in world space.
struct HitsOfInstance {
    const SceneFilter& filter;
    const VisitedInstance& instance;
    Visitor<InstanceId, const RayHit&> visit;

    Visit operator()(const RayHit& hit) const {
        if (filter.keep() && !filter.keep()(instance.id, hit.triangle)) return Visit::next;
        return visit_in_world(instance.id, hit);
    }
    Visit operator()(InstanceId in_tile, const RayHit& hit) const {
        return visit_in_world(instance.id_of(in_tile), hit);
    }

private:
    [[nodiscard]] Visit visit_in_world(InstanceId id, RayHit hit) const {
        hit.normal = normal_to_world(instance.transform, hit.normal);
        return visit(id, hit);
    }
};

QueryStatus list(const SceneView& scene, const SceneRay& ray, Visitor<InstanceId, const RayHit&> visit,
                 const SceneFilter& filter, QueryStatus rounding = QueryStatus::ok) {
    const QueryStatus status = status_without_walk(scene, ray.world(), rounding);
    if (status != QueryStatus::ok) return of_list(status);
    const SceneData& data = data_of(scene);
    const float t_max = ray.world().t_max;
    const Passage passage = ray.passage(data);
    QueryStatus end = QueryStatus::ok;
    const auto visit_instance = [&](const VisitedInstance& instance, float&) {
        const FilterOfInstance keep = {filter, instance};
        const HitsOfInstance each = {filter, instance, visit};
        end = ray.query(instance, t_max, [&](const auto& part, const auto&... local) {
            if constexpr (std::is_same_v<std::remove_cvref_t<decltype(part)>, Blob>)
                return for_each_hit(part, local..., each);
            else return for_each_hit(part, local..., each, keep.of(part));
        });
        end = status_in_scene(end);
        return end == QueryStatus::ok ? Visit::next : Visit::stop;
    };
    visit_instances(data, filter.mask(), passage, passage.key_of(t_max), visit_instance);
    return end;
}

}  // namespace

InScene<RayHit> raycast(const SceneView& scene, const Ray& ray, const SceneFilter& filter) noexcept {
    return with_scene_ray(scene, ray, [&](const SceneRay& in_scene) { return cast(scene, in_scene, filter); });
}

InScene<RayHit> raycast(const SceneView& scene, const Ray& ray, const RoundedRay& rounded,
                        const SceneFilter& filter) noexcept {
    const QueryStatus rounding = refusal_of(rounded.data());
    return with_scene_ray(ray, rounded,
                          [&](const SceneRay& in_scene) { return cast(scene, in_scene, filter, rounding); });
}

Filled raycast(const SceneView& scene, std::span<const Ray> rays, std::span<InScene<RayHit>> hits,
               const SceneFilter& filter) noexcept {
    if (!scene) return {0, {}, refusal_of(scene)};
    if (rays.size() != hits.size()) return {0, {}, QueryStatus::invalid_argument};
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = raycast(scene, rays[i], filter);
    return {rays.size(), {}, QueryStatus::ok};
}

YesNo occluded(const SceneView& scene, const Ray& ray, const SceneFilter& filter) noexcept {
    return with_scene_ray(scene, ray, [&](const SceneRay& in_scene) { return test(scene, in_scene, filter); });
}

YesNo occluded(const SceneView& scene, const Ray& ray, const RoundedRay& rounded, const SceneFilter& filter) noexcept {
    const QueryStatus rounding = refusal_of(rounded.data());
    return with_scene_ray(ray, rounded,
                          [&](const SceneRay& in_scene) { return test(scene, in_scene, filter, rounding); });
}

QueryStatus for_each_hit(const SceneView& scene, const Ray& ray, Visitor<InstanceId, const RayHit&> visit,
                         const SceneFilter& filter) noexcept {
    return with_scene_ray(scene, ray, [&](const SceneRay& in_scene) { return list(scene, in_scene, visit, filter); });
}

QueryStatus for_each_hit(const SceneView& scene, const Ray& ray, const RoundedRay& rounded,
                         Visitor<InstanceId, const RayHit&> visit, const SceneFilter& filter) noexcept {
    const QueryStatus rounding = refusal_of(rounded.data());
    return with_scene_ray(ray, rounded,
                          [&](const SceneRay& in_scene) { return list(scene, in_scene, visit, filter, rounding); });
}

}  // namespace espalier
