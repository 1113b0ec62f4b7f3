// Rays in the caller's units: rounded, answered in lattice units, translated back.
#include <espalier/ray.hpp>
#include <espalier/statistics.hpp>
#include <runtime/ray_queries.hpp>
#include <runtime/simd/dispatch.hpp>

namespace espalier {

using namespace detail;

namespace {

bool prepare(const Blob& blob, const Ray& ray, LatticeRay& rounded) {
    return blob.triangle_count() != 0 && round_ray(blob.data(), ray, rounded);
}

RayHit to_hit(const LatticeRay& rounded, const FoundHit& found, const Ray& ray) {
    const HitSurface surface = surface_of_hit(rounded, found.triangle);
    return {to_t(rounded, found.tau, ray), surface.u, surface.v, surface.normal, Triangle{found.index}};
}

bool closest(const Blob& blob, const Ray& ray, RayHit& hit, const TriangleFilter* filter) {
    LatticeRay rounded;
    FoundHit found;
    if (!prepare(blob, ray, rounded) || !ESPALIER_DISPATCH(closest_hit, blob.data(), rounded, filter, found)) return false;
    hit = to_hit(rounded, found, ray);
    return true;
}

bool any(const Blob& blob, const Ray& ray, const TriangleFilter* filter) {
    LatticeRay rounded;
    return prepare(blob, ray, rounded) && ESPALIER_DISPATCH(any_hit, blob.data(), rounded, filter);
}

}  // namespace

bool raycast(const Blob& blob, const Ray& ray, RayHit& hit) noexcept { return closest(blob, ray, hit, nullptr); }

bool raycast(const Blob& blob, const Ray& ray, RayHit& hit, TriangleFilter filter) {
    return closest(blob, ray, hit, &filter);
}

bool occluded(const Blob& blob, const Ray& ray) noexcept { return any(blob, ray, nullptr); }

bool occluded(const Blob& blob, const Ray& ray, TriangleFilter filter) { return any(blob, ray, &filter); }

bool for_each_hit(const Blob& blob, const Ray& ray, FunctionRef<Visit(const RayHit&)> visit) {
    LatticeRay rounded;
    if (!prepare(blob, ray, rounded)) return true;
    return ESPALIER_DISPATCH(every_hit, blob.data(), rounded,
                             [&](const FoundHit& found) { return visit(to_hit(rounded, found, ray)); });
}

bool raycast_counted(const Blob& blob, const Ray& ray, RayHit& hit, QueryCounters& counters) noexcept {
    LatticeRay rounded;
    FoundHit found;
    if (!prepare(blob, ray, rounded) || !scalar::closest_hit_counted(blob.data(), rounded, found, counters)) return false;
    hit = to_hit(rounded, found, ray);
    return true;
}

}  // namespace espalier
