// The queries of scenes, over instances that move.
#include <runtime/moving_scenes/queries.hpp>

#include <runtime/base/bits.hpp>

#define ESPALIER_PER_SET <runtime/moving_scenes/walks.hpp>
#include <runtime/lanes/for_each_set.hpp>

namespace espalier {

namespace detail {

namespace {

void nearest_to_passage(const Passage& passage, AnyInstanceAnswer& answer) {
    ESPALIER_DISPATCH(moving_instances_nearest_first, passage, answer);
}
void nearest_to_point(const RoundedPoint& point, AnyInstanceAnswer& answer) {
    ESPALIER_DISPATCH(moving_instances_nearest_first, point, answer);
}
Visit in_order(const Passage& passage, AnyInstanceAnswer& answer) {
    return ESPALIER_DISPATCH(moving_instances_in_order, passage, answer);
}
Transform transform_in_block(const SceneData& scene, InstanceId instance) {
    const SceneBlock block = parts_of(const_cast<std::byte*>(scene.tree.bytes));
    return seen_transform(block.slots[instance.index], scene.origin, scene.tree.step_exponent);
}

constexpr MovingInstances moving_instances = {nearest_to_passage, nearest_to_point, in_order, transform_in_block};

}  // namespace

MovingSceneQuery::MovingSceneQuery(const MovingScene& scene) {
    SceneData& data = scene_.data_;
    const QueryStatus readiness = readiness_of(scene);
    data.must_refit = readiness == QueryStatus::not_refitted;
    if (readiness != QueryStatus::ok) return;
    const SceneBlock block = block_of(scene);
    const BlockHead& head = *block.head;
    data.moving = &moving_instances;
    data.meshes = scene.meshes().data();
    data.tiles = scene.tiles().data();
    data.mesh_count = static_cast<std::uint32_t>(scene.meshes().size());
    data.tile_count = static_cast<std::uint32_t>(scene.tiles().size());
    data.instance_count = head.live;
    data.coarsest_step = head.coarseness.coarsest_step;
    data.largest_scale = head.coarseness.largest_scale;
    data.farthest_origin = head.coarseness.farthest_origin;
    const Result<Lattice> common = scene.common_lattice();
    data.has_common = common.status == QueryStatus::ok;
    data.common = common.value;
    data.tree.bytes = static_cast<const std::byte*>(static_cast<const void*>(block.head));
    data.tree.step_exponent = head.step_exponent;
    for (int k = 0; k < 3; ++k) data.origin[k] = MovingSceneAccess::origin(scene)[k];
    if (head.live == 0) return;
    const StepsBox all = block.node(head.root).bounds();
    const float step = power_of_two(head.step_exponent);
    float farthest = 0.0f;
    for (int k = 0; k < 3; ++k) {
        const std::int32_t origin = lattice_point_below(all.low[k]);
        data.tree.origin[k] = static_cast<float>(origin - data.origin[k]) * step;
        data.tree.extent_steps[k] = static_cast<float>(lattice_point_above(all.high[k]) - origin);
        const float end = data.tree.origin[k] + data.tree.extent_steps[k] * step;
        farthest = maximum(maximum(absolute(data.tree.origin[k]), absolute(end)), farthest);
    }
    data.view_slack = (farthest + data.farthest_origin) * 0x1p-23f;
}

YesNo overlaps(const MovingScene& scene, const AnySceneShape& shape, const SceneFilter& filter) noexcept {
    return overlaps(MovingSceneQuery(scene).scene(), shape, filter);
}

QueryStatus for_each_overlap(const MovingScene& scene, const AnySceneShape& shape,
                             Visitor<InstanceId, TriangleId> visit, const SceneFilter& filter) noexcept {
    return for_each_overlap(MovingSceneQuery(scene).scene(), shape, visit, filter);
}

}  // namespace detail

using detail::MovingSceneQuery;

InScene<RayHit> raycast(const MovingScene& scene, const Ray& ray, const SceneFilter& filter) noexcept {
    return raycast(MovingSceneQuery(scene).scene(), ray, filter);
}

InScene<RayHit> raycast(const MovingScene& scene, const Ray& ray, const RoundedRay& rounded,
                        const SceneFilter& filter) noexcept {
    return raycast(MovingSceneQuery(scene).scene(), ray, rounded, filter);
}

Filled raycast(const MovingScene& scene, std::span<const Ray> rays, std::span<InScene<RayHit>> hits,
               const SceneFilter& filter) noexcept {
    return raycast(MovingSceneQuery(scene).scene(), rays, hits, filter);
}

YesNo occluded(const MovingScene& scene, const Ray& ray, const SceneFilter& filter) noexcept {
    return occluded(MovingSceneQuery(scene).scene(), ray, filter);
}

YesNo occluded(const MovingScene& scene, const Ray& ray, const RoundedRay& rounded,
               const SceneFilter& filter) noexcept {
    return occluded(MovingSceneQuery(scene).scene(), ray, rounded, filter);
}

QueryStatus for_each_hit(const MovingScene& scene, const Ray& ray, Visitor<InstanceId, const RayHit&> visit,
                         const SceneFilter& filter) noexcept {
    return for_each_hit(MovingSceneQuery(scene).scene(), ray, visit, filter);
}

QueryStatus for_each_hit(const MovingScene& scene, const Ray& ray, const RoundedRay& rounded,
                         Visitor<InstanceId, const RayHit&> visit, const SceneFilter& filter) noexcept {
    return for_each_hit(MovingSceneQuery(scene).scene(), ray, rounded, visit, filter);
}

InScene<ClosestPoint> closest_point(const MovingScene& scene, Vec3 point, float max_distance,
                                    std::uint32_t mask) noexcept {
    return closest_point(MovingSceneQuery(scene).scene(), point, max_distance, mask);
}

InScene<SweepHit> sweep(const MovingScene& scene, const Sphere& sphere, Vec3 displacement,
                        const SceneSweepOptions& options) noexcept {
    return sweep(MovingSceneQuery(scene).scene(), sphere, displacement, options);
}

InScene<SweepHit> sweep(const MovingScene& scene, const Capsule& capsule, Vec3 displacement,
                        const SceneSweepOptions& options) noexcept {
    return sweep(MovingSceneQuery(scene).scene(), capsule, displacement, options);
}

InScene<SweepHit> sweep(const MovingScene& scene, const Box& box, Vec3 displacement,
                        const SceneSweepOptions& options) noexcept {
    return sweep(MovingSceneQuery(scene).scene(), box, displacement, options);
}

InScene<SweepHit> sweep(const MovingScene& scene, const OrientedBox& box, Vec3 displacement,
                        const SceneSweepOptions& options) noexcept {
    return sweep(MovingSceneQuery(scene).scene(), box, displacement, options);
}

InScene<SweepHit> sweep(const MovingScene& scene, const ConvexHull& hull, Vec3 displacement,
                        const SceneSweepOptions& options) noexcept {
    return sweep(MovingSceneQuery(scene).scene(), hull, displacement, options);
}

QueryStatus for_each_candidate(const MovingScene& scene, const Box& box, Visitor<InstanceId> visit,
                               std::uint32_t mask) noexcept {
    return for_each_candidate(MovingSceneQuery(scene).scene(), box, visit, mask);
}

}  // namespace espalier
