// Shapes that move, against all instances of a scene.
#include <espalier/scene.hpp>
#include <runtime/scenes/instance_walk.hpp>
#include <runtime/scenes/passage.hpp>

namespace espalier {

using namespace detail;

namespace {

template <class Shape>
InScene<SweepHit> sweep_in(const BakedScene& scene, const Shape& shape, Vec3 displacement, const SceneFilter& filter) {
    const ShapeBounds bounds = bounds_of(shape);
    const bool is_sound = is_finite(displacement) && is_finite(shape.radius);
    const QueryStatus status = !scene ? refusal_of(scene) : is_sound ? bounds.status : QueryStatus::invalid_argument;
    if (status != QueryStatus::ok) return BestInScene<SweepHit>(status).result();
    SweepHit miss;
    miss.status = QueryStatus::not_found;
    miss.t = 1.0f;
    BestInScene<SweepHit> best(miss);
    const SceneData& data = data_of(scene);
    const float magnitude =
        maximum(maximum(absolute(displacement.x), absolute(displacement.y)), absolute(displacement.z));
    const Passage passage(data, bounds, displacement, magnitude);
    const auto move = [&](const VisitedInstance& instance, float& limit) {
        const FilterOfInstance keep = {filter, instance};
        InScene<SweepHit> hit = instance.query([&](const auto& part) {
            return in_tile(sweep(part, to_local(instance.transform, shape),
                                 direction_to_local(instance.transform, displacement), keep.of(part)));
        });
        if (!best.is_better(*hit, instance.id_of(hit.instance), &SweepHit::t)) return Visit::next;
        hit.hit.point = to_world(instance.transform, hit->point);
        hit.hit.normal = normal_to_world(instance.transform, hit->normal);
        hit.hit.face_normal = normal_to_world(instance.transform, hit->face_normal);
        best.set(*hit, instance.id_of(hit.instance));
        limit = passage.key_of(limit_above(hit->t));
        return Visit::next;
    };
    visit_nearest_instances(data, filter.mask(), passage, passage.key_of(1.0f), move);
    return best.result();
}

}  // namespace

InScene<SweepHit> sweep(const BakedScene& scene, const Sphere& sphere, Vec3 displacement,
                        const SceneFilter& filter) noexcept {
    return sweep_in(scene, sphere, displacement, filter);
}

InScene<SweepHit> sweep(const BakedScene& scene, const Capsule& capsule, Vec3 displacement,
                        const SceneFilter& filter) noexcept {
    return sweep_in(scene, capsule, displacement, filter);
}

}  // namespace espalier
