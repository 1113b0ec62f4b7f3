// Ray queries, neon.
#include <bit>

#include <runtime/ray_queries.hpp>
#if ESPALIER_NEON
#include <runtime/simd/lanes_neon.hpp>

namespace espalier::detail::neon {
inline bool round(const BlobData& blob, const Ray& world, LatticeRay& ray) { return round_ray(blob, world, ray); }
inline RayLanes spread(const BlobData& blob, const LatticeRay& ray) { return spread_ray(blob, ray); }
#include <runtime/traverse.inl>
#include <runtime/ray_queries.inl>
}  // namespace espalier::detail::neon
#endif
