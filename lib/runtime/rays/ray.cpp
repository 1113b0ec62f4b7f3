// Ray queries: each calls its variant for the instruction set of the machine. At the end, the status of a ray that is
// not traced.
#include <bit>
#include <cstddef>
#include <cstdint>

#include <espalier/advanced/statistics.hpp>
#include <espalier/approximate.hpp>
#include <espalier/ray.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/lattice/rounder.hpp>
#include <runtime/rays/queries.hpp>
#include <runtime/traversal/small_boxes.hpp>

#define ESPALIER_FRAGMENT <runtime/rays/single.hpp>
#include <runtime/lanes/for_each_set.hpp>

namespace espalier {

using namespace detail;

RayHit raycast(const Blob& blob, const Ray& ray, const TriangleFilter& filter) noexcept {
    return ESPALIER_DISPATCH_RAY(closest_hit, data_of(blob), ray, filter);
}

YesNo occluded(const Blob& blob, const Ray& ray, const TriangleFilter& filter) noexcept {
    return ESPALIER_DISPATCH_RAY(any_hit, data_of(blob), ray, filter);
}

Filled closest_hits(const Blob& blob, const Ray& ray, std::span<RayHit> hits, const TriangleFilter& filter) noexcept {
    return ESPALIER_DISPATCH_RAY(first_hits, data_of(blob), ray, hits, filter);
}

QueryStatus for_each_hit(const Blob& blob, const Ray& ray, Visitor<const RayHit&> visit) noexcept {
    return ESPALIER_DISPATCH_RAY(every_hit, data_of(blob), ray, visit);
}

QueryStatus for_each_crossing(const Blob& blob, const Ray& ray, Visitor<const RayHit&> visit) noexcept {
    return ESPALIER_DISPATCH_RAY(every_crossing, data_of(blob), ray, visit);
}

RayHit raycast(const Blob& blob, const Ray& ray, QueryCounters& counters) noexcept {
    return scalar::with_leaves_of(data_of(blob), [&]<class Leaf>() {
        return scalar::closest_hit_in<Leaf>(data_of(blob), ray, no_filter, WalkAccuracy{-1, &counters});
    });
}

YesNo occluded(const Blob& blob, const Ray& ray, Accuracy accuracy, QueryCounters* counters) noexcept {
    const WalkAccuracy for_walk = {steps_in(data_of(blob), accuracy.distance), counters};
    return ESPALIER_DISPATCH_RAY(may_hit, data_of(blob), ray, for_walk);
}

// Out of line: none of it is in the way of a ray that is walked.

ESPALIER_NOINLINE QueryStatus detail::status_without_walk(const BlobData& blob, const Ray& ray) {
    return blob.bytes == nullptr ? QueryStatus::not_open : refusal_or_miss(blob, ray);
}

ESPALIER_NOINLINE QueryStatus detail::refusal_or_miss(const BlobData& blob, const Ray& ray) {
    static_assert(offsetof(Ray, direction) == 12 && offsetof(Ray, t_min) == 24 && offsetof(Ray, culling) == 32);
    const auto number = [&](unsigned i) {
        float result;
        ESPALIER_COPY_BYTES(&result, reinterpret_cast<const std::byte*>(&ray) + std::size_t{4} * i, sizeof result);
        return result;
    };
    // Twice the magnitude's bits: the sign is shifted out.
    const auto magnitude = [&](unsigned i) { return std::bit_cast<std::uint32_t>(number(i)) << 1; };
    constexpr std::uint32_t infinite = infinity_bits << 1;
    std::uint32_t any_direction = 0;
    for (unsigned i = 0; i < 6; ++i) {  // the origin, then the direction
        if (magnitude(i) >= infinite) return QueryStatus::invalid_argument;
        if (i >= 3) any_direction |= magnitude(i);
    }
    if (any_direction == 0 || magnitude(6) > infinite || magnitude(7) > infinite) return QueryStatus::invalid_argument;
    for (unsigned k = 0; k < 3; ++k)
        if (magnitude_bits(to_steps(blob, static_cast<int>(k), number(k))) >= magnitude_bits(0x1p120f))
            return QueryStatus::out_of_range;
    return QueryStatus::not_found;
}

}  // namespace espalier
