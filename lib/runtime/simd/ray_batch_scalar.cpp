// Batches of rays, scalar: one ray after the other. A core without lanes has little to gain from company, and no stack
// for it.
#include <runtime/ray_batch.hpp>
#include <runtime/ray_queries.hpp>

namespace espalier::detail::scalar {

#if ESPALIER_SMALL_CODE
namespace single = small;
#else
namespace single = scalar;
#endif

std::size_t closest_hits(const BlobData& blob, const Ray* rays, RayHit* hits, std::size_t count) {
    return closest_hits_one_by_one<single::closest_hit>(blob, rays, hits, count);
}

std::size_t any_hits(const BlobData& blob, const Ray* rays, std::uint8_t* occluded, std::size_t count) {
    return any_hits_one_by_one<single::any_hit>(blob, rays, occluded, count);
}

}  // namespace espalier::detail::scalar
