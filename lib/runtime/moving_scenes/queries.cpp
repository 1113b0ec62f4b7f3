// A moving scene as queries of scenes take it: the walks over its tree.
#define ESPALIER_FRAGMENT <runtime/moving_scenes/walks.hpp>
#include <runtime/lanes/for_each_set.hpp>

namespace espalier {

using namespace detail;

namespace {

/// Whether there is anything to walk. A view is valid until the next change of its scene; the walk of one that is used
/// after the last instance was removed must not read a root that the block does not have.
bool has_root(const SceneData& scene) { return parts_of(scene.block).head->root != no_child; }

template <class Region>
void nearest_first(const Region& region, AnyInstanceAnswer& answer) {
    if (has_root(answer.scene)) ESPALIER_DISPATCH(moving_instances_nearest_first, region, answer);
}
Visit in_order(const Passage& passage, AnyInstanceAnswer& answer) {
    if (!has_root(answer.scene)) return Visit::next;
    return ESPALIER_DISPATCH(moving_instances_in_order, passage, answer);
}
Transform transform_in_block(const SceneData& scene, InstanceId instance) {
    const SceneBlock block = parts_of(scene.block);
    return seen_transform(block.slots[instance.index], scene.origin, scene.tree.step_exponent);
}

constexpr MovingInstances moving_instances = {nearest_first<Passage>, nearest_first<RoundedPoint>, in_order,
                                              transform_in_block};

}  // namespace

MovingScene::operator SceneView() const noexcept {
    SceneView view;
    SceneData& data = view.data_;
    const QueryStatus readiness = readiness_of(*this);
    data.must_refit = readiness == QueryStatus::not_refitted;
    if (readiness != QueryStatus::ok) return view;
    const SceneBlock block = block_of(*this);
    const BlockHead& head = *block.head;
    data.moving = &moving_instances;
    data.block = block_;
    data.meshes = meshes().data();
    data.tiles = tiles().data();
    data.mesh_count = static_cast<std::uint32_t>(meshes().size());
    data.tile_count = static_cast<std::uint32_t>(tiles().size());
    data.instance_count = head.live;
    data.coarsest_step = head.coarseness.coarsest_step;
    data.largest_scale = head.coarseness.largest_scale;
    data.farthest_origin = head.coarseness.farthest_origin;
    const Result<Lattice> common = common_lattice();
    data.has_common = common.status == QueryStatus::ok;
    data.common = common.value;
    data.tree.bytes = block_;
    data.tree.step_exponent = head.step_exponent;
    for (int k = 0; k < 3; ++k) data.origin[k] = origin_[k];
    if (head.live == 0) return view;
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
    return view;
}

}  // namespace espalier
