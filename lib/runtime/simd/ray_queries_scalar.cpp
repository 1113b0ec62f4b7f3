// Ray queries, scalar.
#include <bit>

#include <runtime/ray_queries.hpp>
#include <runtime/simd/lanes_scalar.hpp>

namespace espalier::detail::scalar {
#include <runtime/traverse.inl>
#include <runtime/ray_queries.inl>

bool closest_hit_counted(const BlobData& blob, const LatticeRay& ray, FoundHit& best, QueryCounters& counters) {
    return closest_hit_counting(blob, ray, nullptr, best, counters);
}
}  // namespace espalier::detail::scalar
