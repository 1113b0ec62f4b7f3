// Rays: the variant of each query that suits the machine.
#include <espalier/ray.hpp>
#include <espalier/advanced/statistics.hpp>
#include <runtime/rays/queries.hpp>

#define ESPALIER_PER_SET <runtime/rays/single.hpp>
#include <runtime/lanes/for_each_set.hpp>

namespace espalier {

using namespace detail;

namespace {

const TriangleFilter* given(const TriangleFilter& filter) { return filter ? &filter : nullptr; }

}  // namespace

RayHit raycast(const Blob& blob, const Ray& ray, TriangleFilter filter) noexcept {
    return ESPALIER_DISPATCH_RAY(closest_hit, data_of(blob), ray, given(filter));
}

YesNo occluded(const Blob& blob, const Ray& ray, TriangleFilter filter) noexcept {
    return ESPALIER_DISPATCH_RAY(any_hit, data_of(blob), ray, given(filter));
}

Filled closest_hits(const Blob& blob, const Ray& ray, std::span<RayHit> hits, TriangleFilter filter) noexcept {
    return ESPALIER_DISPATCH_RAY(first_hits, data_of(blob), ray, hits, given(filter));
}

QueryStatus for_each_hit(const Blob& blob, const Ray& ray, Visitor<const RayHit&> visit) noexcept {
    return ESPALIER_DISPATCH_RAY(every_hit, data_of(blob), ray, visit);
}

QueryStatus for_each_crossing(const Blob& blob, const Ray& ray, Visitor<const RayHit&> visit) noexcept {
    return ESPALIER_DISPATCH_RAY(every_crossing, data_of(blob), ray, visit);
}

RayHit raycast(const Blob& blob, const Ray& ray, QueryCounters& counters) noexcept {
    return scalar::find_closest_hit(data_of(blob), ray, nullptr, WalkAccuracy{-1, &counters});
}

}  // namespace espalier
