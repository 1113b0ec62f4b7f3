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
    std::size_t found = 0;
    for (std::size_t i = 0; i < count; ++i) {
        hits[i] = no_hit;
        if (single::closest_hit(blob, rays[i], hits[i], nullptr)) ++found;
    }
    return found;
}

std::size_t any_hits(const BlobData& blob, const Ray* rays, std::uint8_t* occluded, std::size_t count) {
    std::size_t found = 0;
    for (std::size_t i = 0; i < count; ++i) {
        occluded[i] = single::any_hit(blob, rays[i], nullptr) ? 1 : 0;
        found += occluded[i];
    }
    return found;
}

}  // namespace espalier::detail::scalar
