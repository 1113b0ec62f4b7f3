// Batches of rays: the variant that suits the machine.
#include <espalier/ray.hpp>
#include <runtime/ray_batch.hpp>
#include <runtime/simd/dispatch.hpp>

namespace espalier {

using namespace detail;

std::size_t raycast(const Blob& blob, std::span<const Ray> rays, std::span<RayHit> hits) noexcept {
    const std::size_t count = rays.size() < hits.size() ? rays.size() : hits.size();
    if (blob.triangle_count() != 0)
        return ESPALIER_DISPATCH(closest_hits, blob.data(), rays.data(), hits.data(), count);
    for (RayHit& hit : hits.first(count)) hit = no_hit;
    return 0;
}

std::size_t occluded(const Blob& blob, std::span<const Ray> rays, std::span<std::uint8_t> answers) noexcept {
    const std::size_t count = rays.size() < answers.size() ? rays.size() : answers.size();
    if (blob.triangle_count() != 0) return ESPALIER_DISPATCH(any_hits, blob.data(), rays.data(), answers.data(), count);
    for (std::uint8_t& answer : answers.first(count)) answer = 0;
    return 0;
}

}  // namespace espalier
