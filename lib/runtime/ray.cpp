// Rays: the variant of each query that suits the machine.
#include <espalier/ray.hpp>
#include <espalier/statistics.hpp>
#include <runtime/ray_queries.hpp>
#include <runtime/simd/dispatch.hpp>

namespace espalier {

using namespace detail;

bool raycast(const Blob& blob, const Ray& ray, RayHit& hit) noexcept {
    return blob.triangle_count() != 0 && ESPALIER_DISPATCH_RAY(closest_hit, blob.data(), ray, hit, nullptr);
}

bool raycast(const Blob& blob, const Ray& ray, RayHit& hit, TriangleFilter filter) {
    return blob.triangle_count() != 0 && ESPALIER_DISPATCH_RAY(closest_hit, blob.data(), ray, hit, &filter);
}

bool occluded(const Blob& blob, const Ray& ray) noexcept {
    return blob.triangle_count() != 0 && ESPALIER_DISPATCH_RAY(any_hit, blob.data(), ray, nullptr);
}

bool occluded(const Blob& blob, const Ray& ray, TriangleFilter filter) {
    return blob.triangle_count() != 0 && ESPALIER_DISPATCH_RAY(any_hit, blob.data(), ray, &filter);
}

HitCount closest_hits(const Blob& blob, const Ray& ray, std::span<RayHit> hits) noexcept {
    if (blob.triangle_count() == 0) return {};
    return ESPALIER_DISPATCH_RAY(first_hits, blob.data(), ray, hits, nullptr);
}

HitCount closest_hits(const Blob& blob, const Ray& ray, std::span<RayHit> hits, TriangleFilter filter) {
    if (blob.triangle_count() == 0) return {};
    return ESPALIER_DISPATCH_RAY(first_hits, blob.data(), ray, hits, &filter);
}

bool for_each_hit(const Blob& blob, const Ray& ray, FunctionRef<Visit(const RayHit&)> visit) {
    if (blob.copy_count() != 0) return false;
    return blob.triangle_count() == 0 || ESPALIER_DISPATCH_RAY(every_hit, blob.data(), ray, visit);
}

bool raycast_counted(const Blob& blob, const Ray& ray, RayHit& hit, QueryCounters& counters) noexcept {
    return blob.triangle_count() != 0 && scalar::closest_hit_counted(blob.data(), ray, hit, counters);
}

}  // namespace espalier
