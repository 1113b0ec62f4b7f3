// The walks over the instances whose boxes a passage meets, or that are near a point.
#ifndef ESPALIER_SCENES_WALKS_HPP
#define ESPALIER_SCENES_WALKS_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/proximity/point_nodes.hpp>
#include <runtime/rays/slab_test.hpp>
#include <runtime/scenes/closest_ray.hpp>
#include <runtime/scenes/instance_walk.hpp>

ESPALIER_BEGIN_SET

namespace {

using PassageLanes = RayLanesOf<PackedNode>;

template <class Region, class Answer>
struct InstanceWalk {
    struct CostlyLeaves {};

    const Region& region;
    Answer& answer;

    // Small cores need the stack of this function again for the query of an instance.
    ESPALIER_SHARED_OR_PART_OF_CALLER unsigned children(const PackedNode& node, Keys keys) const {
        if constexpr (std::is_same_v<Region, PassageLanes>) return slab_test(node, region, answer.limit, keys);
        else return distance_test(node, region, answer.scene.tree, answer.limit, keys);
    }
    [[nodiscard]] float limit() const { return answer.limit; }
    ESPALIER_ALWAYS_INLINE Visit visit_leaf(const InstancePlace& place) { return answer.take(place); }
};

/// Visits the instances whose boxes a passage meets, the nearest first.
template <class Answer>
ESPALIER_ALWAYS_INLINE inline void walk_nearest_first(const Passage& passage, Answer& answer) {
    const BlobData& tree = answer.scene.tree;
    const auto passage_lanes = passage.lanes<PassageLanes>(tree);
    InstanceWalk<PassageLanes, Answer> walk = {passage_lanes, answer};
    (traverse_nearest_first<InstancePlace>)(tree, walk);
}

}  // namespace

ESPALIER_QUERY_OF_SET void instances_nearest_first(const Passage& passage, AnyInstanceAnswer& answer) {
    (walk_nearest_first)(passage, answer);
}

ESPALIER_QUERY_OF_SET void instances_nearest_first(const RoundedPoint& point, AnyInstanceAnswer& answer) {
    InstanceWalk<RoundedPoint, AnyInstanceAnswer> walk = {point, answer};
    (traverse_nearest_first<InstancePlace>)(answer.scene.tree, walk);
}

ESPALIER_QUERY_OF_SET Visit instances_in_order(const Passage& passage, AnyInstanceAnswer& answer) {
    const BlobData& tree = answer.scene.tree;
    const auto passage_lanes = passage.lanes<PassageLanes>(tree);
    InstanceWalk<PassageLanes, AnyInstanceAnswer> walk = {passage_lanes, answer};
    return (walk_in_storage_order<InstancePlace>)(tree, walk);
}

ESPALIER_QUERY_OF_SET void search_nearest_first(ClosestRay& closest) {
#if ESPALIER_LANES == 1
    using Visitor = ClosestRayVisitor<single_rays::closest_hit>;
#else
    using Visitor = ClosestRayVisitor<closest_hit>;
#endif
    const Visitor visit = {closest};
    InstanceAnswer<Visitor> answer = {closest.scene(), closest.mask(), closest.limit(), visit};
    (walk_nearest_first)(closest.passage(), answer);
}

ESPALIER_END_SET

#endif
