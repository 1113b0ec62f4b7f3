// Ray queries, scalar.
#include <bit>

#include <runtime/ray_queries.hpp>
#include <runtime/simd/lanes_scalar.hpp>

namespace espalier::detail::scalar {
inline bool round(const BlobData& blob, const Ray& world, LatticeRay& ray) { return round_ray(blob, world, ray); }
inline RayLanes spread(const BlobData& blob, const LatticeRay& ray) { return spread_ray(blob, ray); }
#include <runtime/traverse.inl>
#include <runtime/ray_queries.inl>

bool closest_hit_counted(const BlobData& blob, const Ray& world, RayHit& hit, QueryCounters& counters) {
    return closest_hit_counting(blob, world, hit, nullptr, counters);
}

}  // namespace espalier::detail::scalar
