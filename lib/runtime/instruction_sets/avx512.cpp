// AVX-512: leaves and plain nodes sixteen lanes at a time, packed nodes and the ray itself as with AVX2. Two blobs have
// a file of their own.
#include <runtime/instruction_sets/queries.hpp>
#if ESPALIER_HAS_AVX512
#include <runtime/lanes/avx512.hpp>

ESPALIER_BEGIN_TARGET(ESPALIER_AVX2)
namespace espalier::detail::avx2 {
#include <runtime/rays/prepare_ray.inl>
#include <runtime/rays/slab_test_avx2.inl>
#include <runtime/proximity/squared_distance.inl>
#include <runtime/proximity/point_nodes.inl>
#include <runtime/proximity/pair_nodes.inl>
}  // namespace espalier::detail::avx2
ESPALIER_END_TARGET

ESPALIER_BEGIN_TARGET(ESPALIER_AVX512)
namespace espalier::detail::avx512 {
using avx2::distance_test;
using avx2::overlap_test;
using avx2::pair_test;
using avx2::prepare;
using avx2::RayLanesOf;  // the slab test of packed nodes is found by its argument
#include <runtime/traversal/traverse.inl>
#include <runtime/traversal/find.inl>
#include <runtime/proximity/squared_distance.inl>
#include <runtime/instruction_sets/one_blob.inl>
#include <runtime/overlap/volume_queries.inl>
#include <runtime/rays/batch/batch.inl>
#include <runtime/scenes/instance_walk.inl>
#include <runtime/moving_scenes/box_tree/self_join.inl>
}  // namespace espalier::detail::avx512
ESPALIER_END_TARGET
#endif
