// The first few hits of a ray, as they are collected.
#pragma once

#include <cstdint>
#include <span>

#include <espalier/ray.hpp>
#include <runtime/first_few.hpp>
#include <runtime/lattice_ray.hpp>

namespace espalier::detail {

/// Hits in the caller's array. Until all are found, their t is tau counted from the caller's origin, by which they are
/// ordered.
class FirstHits {
public:
    explicit FirstHits(std::span<RayHit> hits) : hits_(hits, comes_before) {}

    [[nodiscard]] bool has_overflowed() const { return hits_.has_overflowed(); }
    [[nodiscard]] bool has_no_places() const { return hits_.is_empty(); }
    [[nodiscard]] float last_tau() const { return hits_.last().t; }
    [[nodiscard]] bool has(const BlobData& blob, std::uint32_t index) const { return hits_.has(blob, index); }
    void offer(const RayHit& hit) { hits_.offer(hit); }
    HitCount finish(const IntegerRay& ray, const Ray& world, std::span<RayHit> hits) {
        hits_.sort();
        for (RayHit& hit : hits.first(hits_.count())) hit.t = to_t(ray, hit.t, world);
        return {hits_.count(), hits_.has_overflowed() ? QueryStatus::output_full : QueryStatus::ok};
    }

private:
    static bool comes_before(const RayHit& a, const RayHit& b) {
        // mutant(< -> <= 1, < -> <= 2) equivalent: the two differ here, since no triangle is kept twice
        return a.t != b.t ? a.t < b.t : a.triangle.index < b.triangle.index;
    }

    FirstFew<RayHit, bool (*)(const RayHit&, const RayHit&)> hits_;
};

}  // namespace espalier::detail
