// Rays against all instances of a scene.
#include <type_traits>

#include <espalier/rounding.hpp>
#include <espalier/scene.hpp>
#include <runtime/lattice/rounder.hpp>
#include <runtime/rays/queries.hpp>
#include <runtime/scenes/instance_walk.hpp>
#include <runtime/scenes/passage.hpp>

namespace espalier {

using namespace detail;

namespace {

/// Returns ok if the ray must be walked, else the status of the query.
QueryStatus status_without_walk(const BakedScene& scene, const Ray& ray, const RoundedRay* rounded) {
    if (!scene) return QueryStatus::not_open;
    if (rounded != nullptr)
        if (const QueryStatus refusal = refusal_of(rounded->data()); refusal != QueryStatus::ok) return refusal;
    // Which origins are out of range depends on the lattices of the instances.
    const QueryStatus status = refusal_or_miss(data_of(scene).tree, ray);
    if (status == QueryStatus::invalid_argument) return status;
    // The window, by its bits: subnormal numbers are compared alike in every mode.
    const bool starts_before = is_negative(ray.t_min) || magnitude_bits(ray.t_min) <= magnitude_bits(ray.t_max);
    return is_radius(ray.t_max) && starts_before ? QueryStatus::ok : QueryStatus::not_found;
}

/// Returns whether to_local() may turn the direction by more than a rounding, because it takes coordinates below 2^-100
/// for zero, in the world and in local space.
bool is_tiny(const SceneData& scene, const Vec3& direction) {
    const float longest = maximum(maximum(absolute(direction.x), absolute(direction.y)), absolute(direction.z));
    return longest < 0x1p-70f * maximum(scene.largest_scale, 1.0f);
}

/// Returns the longest way along an axis from a point to an end of a region.
float reach_of(const Lattice& region, const Vec3& point) {
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
    /// Without a rounded ray, rounds for the common lattice.
    SceneRay(const SceneData& scene, const Ray& world, const RoundedRay* rounded) : world_(world) {
        if (rounded != nullptr) rounded_ = *rounded;
        else if (scene.has_common) rounded_ = round_ray(scene.common, world);
        if (rounded != nullptr && is_region(rounded_.data().region)) region_ = &rounded_.data().region;
        if (rounded == nullptr && scene.has_common) region_ = &scene.common;
    }

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
    auto query(const VisitedInstance& instance, float t_max, Query query) const {
        if (instance.mesh == nullptr) return query_tile(instance, t_max, query);
        if (region_ != nullptr && lies_in(*region_, *instance.mesh, instance.transform))
            return query_on_lattice(instance, t_max, query);
        return query(*instance.mesh, local_ray(instance, t_max));
    }

private:
    [[nodiscard]] Ray local_ray(const VisitedInstance& instance, float t_max) const {
        Ray local = to_local(instance.transform, world_);
        local.t_max = minimum(t_max, local.t_max);
        return local;
    }
    // Each kind of instance has a frame of its own: the stack is that of one of them.
    template <class Query>
    [[gnu::noinline]] auto query_on_lattice(const VisitedInstance& instance, float t_max, Query query) const {
        RoundedRay local = to_local(instance.transform, rounded_);
        shorten(local, t_max);
        return query(*instance.mesh, local);
    }
    template <class Query>
    [[gnu::noinline]] auto query_tile(const VisitedInstance& instance, float t_max, Query query) const {
        const Ray local = local_ray(instance, t_max);
        if (region_ == nullptr || !lies_in(*region_, *instance.tile, instance.transform))
            return query(*instance.tile, local);
        return query(*instance.tile, local, to_local(instance.transform, rounded_));
    }

    const Ray& world_;
    RoundedRay rounded_;
    const Lattice* region_ = nullptr;  ///< that the ray is rounded for; null if there is none
};

InScene<RayHit> cast(const BakedScene& scene, const Ray& ray, const RoundedRay* rounded, const SceneFilter& filter) {
    QueryStatus status = status_without_walk(scene, ray, rounded);
    BestInScene<RayHit> best(status == QueryStatus::ok ? QueryStatus::not_found : status);
    if (status != QueryStatus::ok) return best.result();
    const SceneData& data = data_of(scene);
    const SceneRay in_scene(data, ray, rounded);
    const Passage passage = in_scene.passage(data);
    const auto visit = [&](const VisitedInstance& instance, float& limit) {
        const FilterOfInstance keep = {filter, instance};
        InScene<RayHit> hit = in_scene.query(
            instance, best ? limit_above(best->t) : ray.t_max,
            [&](const auto& part, const auto&... local) { return in_tile(raycast(part, local..., keep.of(part))); });
        if (!best.is_better(*hit, instance.id_of(hit.instance), &RayHit::t)) return Visit::next;
        hit.hit.normal = normal_to_world(instance.transform, hit->normal);
        best.set(*hit, instance.id_of(hit.instance));
        limit = passage.key_of(limit_above(hit->t));
        return Visit::next;
    };
    visit_nearest_instances(data, filter.mask(), passage, passage.key_of(ray.t_max), visit);
    return best.result();
}

YesNo test(const BakedScene& scene, const Ray& ray, const RoundedRay* rounded, const SceneFilter& filter) {
    const QueryStatus status = status_without_walk(scene, ray, rounded);
    if (status != QueryStatus::ok) return YesNo(status);
    const SceneData& data = data_of(scene);
    const SceneRay in_scene(data, ray, rounded);
    const Passage passage = in_scene.passage(data);
    QueryStatus refusal = QueryStatus::not_found;
    const auto visit = [&](const VisitedInstance& instance, float&) {
        const FilterOfInstance keep = {filter, instance};
        const YesNo answer = in_scene.query(instance, ray.t_max, [&](const auto& part, const auto&... local) {
            return occluded(part, local..., keep.of(part));
        });
        if (is_refused(answer.status())) refusal = answer.status();
        return answer.yes() ? Visit::stop : Visit::next;
    };
    const Visit end = visit_instances(data, filter.mask(), passage, passage.key_of(ray.t_max), visit);
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

QueryStatus list(const BakedScene& scene, const Ray& ray, const RoundedRay* rounded,
                 Visitor<InstanceId, const RayHit&> visit, const SceneFilter& filter) {
    const QueryStatus status = status_without_walk(scene, ray, rounded);
    if (status != QueryStatus::ok) return of_list(status);
    const SceneData& data = data_of(scene);
    const SceneRay in_scene(data, ray, rounded);
    const Passage passage = in_scene.passage(data);
    QueryStatus end = QueryStatus::ok;
    const auto visit_instance = [&](const VisitedInstance& instance, float&) {
        const FilterOfInstance keep = {filter, instance};
        const HitsOfInstance each = {filter, instance, visit};
        end = in_scene.query(instance, ray.t_max, [&](const auto& part, const auto&... local) {
            if constexpr (std::is_same_v<std::remove_cvref_t<decltype(part)>, Blob>)
                return for_each_hit(part, local..., each);
            else return for_each_hit(part, local..., each, keep.of(part));
        });
        return end == QueryStatus::ok ? Visit::next : Visit::stop;
    };
    visit_instances(data, filter.mask(), passage, passage.key_of(ray.t_max), visit_instance);
    return end;
}

}  // namespace

InScene<RayHit> raycast(const BakedScene& scene, const Ray& ray, const SceneFilter& filter) noexcept {
    return cast(scene, ray, nullptr, filter);
}

InScene<RayHit> raycast(const BakedScene& scene, const Ray& ray, const RoundedRay& rounded,
                        const SceneFilter& filter) noexcept {
    return cast(scene, ray, &rounded, filter);
}

Filled raycast(const BakedScene& scene, std::span<const Ray> rays, std::span<InScene<RayHit>> hits,
               const SceneFilter& filter) noexcept {
    if (!scene) return {0, {}, QueryStatus::not_open};
    if (rays.size() != hits.size()) return {0, {}, QueryStatus::invalid_argument};
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = raycast(scene, rays[i], filter);
    return {rays.size(), {}, QueryStatus::ok};
}

YesNo occluded(const BakedScene& scene, const Ray& ray, const SceneFilter& filter) noexcept {
    return test(scene, ray, nullptr, filter);
}

YesNo occluded(const BakedScene& scene, const Ray& ray, const RoundedRay& rounded, const SceneFilter& filter) noexcept {
    return test(scene, ray, &rounded, filter);
}

QueryStatus for_each_hit(const BakedScene& scene, const Ray& ray, Visitor<InstanceId, const RayHit&> visit,
                         const SceneFilter& filter) noexcept {
    return list(scene, ray, nullptr, visit, filter);
}

QueryStatus for_each_hit(const BakedScene& scene, const Ray& ray, const RoundedRay& rounded,
                         Visitor<InstanceId, const RayHit&> visit, const SceneFilter& filter) noexcept {
    return list(scene, ray, &rounded, visit, filter);
}

}  // namespace espalier
