// One lane, for every machine.
#include <runtime/instruction_sets/queries.hpp>
#include <runtime/lanes/scalar.hpp>
#include <runtime/traversal/scalar_walk.hpp>

namespace espalier::detail::scalar {
using scalar_walk::find_each;
using scalar_walk::find_nearest_first;
using scalar_walk::find_nearest_first_in;
#include <runtime/rays/prepare_ray_portable.inl>
#include <runtime/rays/slab_test.inl>
#include <runtime/traversal/traverse.inl>
#include <runtime/traversal/query.inl>
#include <runtime/proximity/squared_distance.inl>
#include <runtime/proximity/point_nodes.inl>
#include <runtime/proximity/pair_nodes.inl>
#include <runtime/instruction_sets/one_blob.inl>
#include <runtime/pairs/search_pairs.inl>
#include <runtime/scenes/instance_walk.inl>
#include <runtime/moving_scenes/box_tree/self_join.inl>
#include <runtime/moving_scenes/walks.inl>

ESPALIER_QUERY_OF_SET RayHit closest_hit_counted(const BlobData& blob, const Ray& world, QueryCounters& counters) {
    return find_closest_hit(blob, world, nullptr, WalkAccuracy{-1, &counters});
}

ESPALIER_QUERY_OF_SET void count_join(const SceneBlock& block, JoinedSlots joined, std::uint32_t slot,
                                      const OnTouchingBoxes& visit, SceneCounters& counters) {
    join_counting(block, joined, slot, visit, Counted{&counters});
}

// One ray after the other: a core without lanes has little to gain from company, and no stack for it.
ESPALIER_QUERY_OF_SET void closest_hits(const BlobData& blob, const Ray* rays, RayHit* hits, std::size_t count) {
    closest_hits_one_by_one<single_rays::closest_hit>(blob, rays, hits, count);
}

ESPALIER_QUERY_OF_SET void any_hits(const BlobData& blob, const Ray* rays, YesNo* occluded, std::size_t count) {
    any_hits_one_by_one<single_rays::any_hit>(blob, rays, occluded, count);
}

}  // namespace espalier::detail::scalar
