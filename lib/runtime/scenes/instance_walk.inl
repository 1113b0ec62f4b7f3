// The walks over the instances whose boxes a passage meets, or that are near a point.
#ifndef ESPALIER_IN_INSTRUCTION_SET  // parsed alone
#include <runtime/proximity/point_nodes.inl>
#include <runtime/rays/slab_test.inl>
#include <runtime/scenes/instance_walk.hpp>
#endif

namespace {

using PassageLanes = RayLanesOf<PackedNode>;

template <class Region>
struct InstanceWalk {
    const Region& region;
    InstanceAnswer& answer;

    [[gnu::always_inline]] unsigned children(const PackedNode& node, Keys keys) const {
        if constexpr (std::is_same_v<Region, PassageLanes>) return slab_test(node, region, answer.limit, keys);
        else return distance_test(node, region, answer.scene.tree, answer.limit, keys);
    }
    [[nodiscard]] float limit() const { return answer.limit; }
    Visit visit_leaf(const InstancePlace& place) { return answer.take(place); }
};

}  // namespace

void instances_nearest_first(const Passage& passage, InstanceAnswer& answer) {
    const BlobData& tree = answer.scene.tree;
    const auto lanes_ = passage.lanes<PassageLanes>(tree);
    InstanceWalk<PassageLanes> walk = {lanes_, answer};
    (traverse_nearest_first<InstancePlace>)(tree, walk);
}

void instances_nearest_first(const RoundedPoint& point, InstanceAnswer& answer) {
    InstanceWalk<RoundedPoint> walk = {point, answer};
    (traverse_nearest_first<InstancePlace>)(answer.scene.tree, walk);
}

Visit instances_in_order(const Passage& passage, InstanceAnswer& answer) {
    const BlobData& tree = answer.scene.tree;
    const auto lanes_ = passage.lanes<PassageLanes>(tree);
    InstanceWalk<PassageLanes> walk = {lanes_, answer};
    return (walk_in_storage_order<InstancePlace>)(tree, walk);
}
