#include <runtime/scenes/closest_ray.hpp>
#include <runtime/scenes/instance_walk.hpp>

#define ESPALIER_FRAGMENT <runtime/scenes/walks.hpp>
#include <runtime/lanes/for_each_set.hpp>

namespace espalier::detail {

void visit_nearest_instances(const SceneData& scene, std::uint32_t mask, const Passage& passage, float limit,
                             const InstanceVisitor& visit) {
    if (scene.instance_count == 0) return;
    AnyInstanceAnswer answer = {scene, mask, limit, visit};
    if (scene.moving != nullptr) return scene.moving->nearest_to_passage(passage, answer);
    ESPALIER_DISPATCH(instances_nearest_first, passage, answer);
}

void visit_nearest_instances(const SceneData& scene, std::uint32_t mask, const RoundedPoint& point, float limit,
                             const InstanceVisitor& visit) {
    if (scene.instance_count == 0) return;
    AnyInstanceAnswer answer = {scene, mask, limit, visit};
    if (scene.moving != nullptr) return scene.moving->nearest_to_point(point, answer);
    ESPALIER_DISPATCH(instances_nearest_first, point, answer);
}

Visit visit_instances(const SceneData& scene, std::uint32_t mask, const Passage& passage, float limit,
                      const InstanceVisitor& visit, const BoxInSteps* meeting) {
    if (scene.instance_count == 0) return Visit::next;
    AnyInstanceAnswer answer = {scene, mask, limit, visit, meeting};
    if (scene.moving != nullptr) return scene.moving->in_order(passage, answer);
    return ESPALIER_DISPATCH(instances_in_order, passage, answer);
}

void search_by_best_set(ClosestRay& closest) { ESPALIER_DISPATCH(search_nearest_first, closest); }

}  // namespace espalier::detail
