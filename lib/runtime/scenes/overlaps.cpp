// Shapes that stay where they are, against all instances of a scene.
#include <espalier/scene.hpp>
#include <runtime/scenes/instance_walk.hpp>
#include <runtime/scenes/passage.hpp>

namespace espalier {

using namespace detail;

namespace {

/// Returns ok if the shape must be walked, not_found if it is empty, or a refusal.
QueryStatus check(const SceneView& scene, const ShapeBounds& bounds) {
    return scene ? bounds.status : refusal_of(scene);
}

}  // namespace

YesNo detail::overlaps(const SceneView& scene, const AnySceneShape& shape, const SceneFilter& filter) noexcept {
    const QueryStatus status = check(scene, shape.bounds);
    if (status != QueryStatus::ok) return YesNo(status);
    QueryStatus refusal = QueryStatus::not_found;
    const auto test = [&](const VisitedInstance& instance, float&) {
        const FilterOfInstance keep = {filter, instance};
        if (instance.mesh == nullptr || !filter.keep()) {
            const YesNo answer = instance.mesh != nullptr ? shape.test(*instance.mesh, instance.transform, shape.shape)
                                                          : shape.test_tile(*instance.tile, instance.transform,
                                                                            shape.shape, keep.of(*instance.tile));
            if (is_refused(answer.status())) refusal = status_in_scene(answer.status());
            return answer.yes() ? Visit::stop : Visit::next;
        }
        const auto kept = [&](TriangleId triangle) { return keep(triangle) ? Visit::stop : Visit::next; };
        const QueryStatus end = shape.visit(*instance.mesh, instance.transform, shape.shape, kept);
        if (is_refused(end)) refusal = status_in_scene(end);
        return end == QueryStatus::stopped ? Visit::stop : Visit::next;
    };
    const Visit end = visit_meeting(scene, shape.bounds, filter.mask(), test);
    return YesNo(end == Visit::stop ? QueryStatus::ok : refusal);
}

QueryStatus detail::for_each_overlap(const SceneView& scene, const AnySceneShape& shape,
                                     Visitor<InstanceId, TriangleId> visit, const SceneFilter& filter) noexcept {
    QueryStatus end = check(scene, shape.bounds);
    if (end != QueryStatus::ok) return of_list(end);
    const auto list = [&](const VisitedInstance& instance, float&) {
        const FilterOfInstance keep = {filter, instance};
        const auto each = [&](TriangleId triangle) {
            if (filter.keep() && !keep(triangle)) return Visit::next;
            return visit(instance.id, triangle);
        };
        const auto each_in_tile = [&](InstanceId in_tile, TriangleId triangle) {
            return visit(instance.id_of(in_tile), triangle);
        };
        end = instance.mesh != nullptr ? shape.visit(*instance.mesh, instance.transform, shape.shape, each)
                                       : shape.visit_tile(*instance.tile, instance.transform, shape.shape, each_in_tile,
                                                          keep.of(*instance.tile));
        end = status_in_scene(end);
        return end == QueryStatus::ok ? Visit::next : Visit::stop;
    };
    visit_meeting(scene, shape.bounds, filter.mask(), list);
    return end;
}

QueryStatus for_each_candidate(const SceneView& scene, const Box& box, Visitor<InstanceId> visit,
                               std::uint32_t mask) noexcept {
    const ShapeBounds bounds = bounds_of(box);
    const QueryStatus status = check(scene, bounds);
    if (status != QueryStatus::ok) return of_list(status);
    const auto each = [&](const VisitedInstance& instance, float&) {
        if (instance.mesh != nullptr) return visit(instance.id);
        const auto each_in_tile = [&](const VisitedInstance& in_tile, float&) {
            return visit(instance.id_of(in_tile.id));
        };
        return visit_meeting(*instance.tile, bounds_of(to_local(instance.transform, box)), mask, each_in_tile);
    };
    const Visit end = visit_meeting(scene, bounds, mask, each);
    return end == Visit::stop ? QueryStatus::stopped : QueryStatus::ok;
}

}  // namespace espalier
