// Ray queries, scalar.
#include <bit>

#include <runtime/ray_queries.hpp>
#include <runtime/small_boxes.hpp>
#include <runtime/simd/lanes_scalar.hpp>

namespace espalier::detail::scalar {
#include <runtime/simd/prepare_ray_portable.inl>
#include <runtime/traverse.inl>
#include <runtime/ray_nodes.inl>
#include <runtime/ray_plain_nodes.inl>
#include <runtime/float_vertices.inl>
#include <runtime/pair_vertices.inl>
#include <runtime/unpacked_leaf.inl>
#include <runtime/ray_filter.inl>
#include <runtime/ray_visitors.inl>
#include <runtime/ray_queries.inl>
#include <runtime/approximate_rays.inl>

bool closest_hit_counted(const BlobData& blob, const Ray& world, RayHit& hit, QueryCounters& counters) {
    return closest_hit_counting(blob, world, hit, nullptr, counters);
}

}  // namespace espalier::detail::scalar
