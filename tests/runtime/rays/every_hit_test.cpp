// Claims about every hit of a ray: against exact arithmetic over all triangles.
#include "support/testing.hpp"

#include "support/exact/as_rationals.hpp"

namespace espalier::tests::every_hit_test {
namespace {

/// Collects the hits before a test requires anything of them, because no exception may pass through the runtime.
std::vector<RayHit> every_hit(const Blob& blob, const Ray& ray) {
    std::vector<RayHit> hits;
    static_cast<void>(for_each_hit(blob, ray, [&](const RayHit& hit) { hits.push_back(hit); }));
    return hits;
}

struct ExactHit {
    std::uint32_t index;
    oracle::Crossing crossing;
};

/// What the rounded ray hits, by the oracle.
std::vector<ExactHit> exact_hits(const DecodedBlob& decoded, const detail::LatticeRay& rounded, FaceCulling culling) {
    const oracle::Line line = exact_line(rounded);
    const Rational low = Rational::of(rounded.tau_min);
    const std::optional<Rational> high =
        std::isinf(rounded.tau_max) ? std::nullopt : std::optional(Rational::of(rounded.tau_max));
    std::vector<ExactHit> hits;
    for (std::uint32_t i = 0; i < decoded.triangles.size(); ++i) {
        const auto crossing = oracle::cross(line, exact_triangle(decoded.triangles[i]));
        if (!crossing || crossing->t < low || (high && *high < crossing->t)) continue;
        if (culling != FaceCulling::none && (culling == FaceCulling::back) != crossing->front) continue;
        hits.push_back({i, *crossing});
    }
    return hits;
}

/// In units of the caller's t.
Rational exact_t(const detail::LatticeRay& rounded, const Rational& tau) {
    return (Rational::of(rounded.tau_offset) + tau) * Rational::of(1, rounded.t_exponent);
}

TEST_CASE("ray: every hit is found with t and u and v within 4 ulp") {
    // Times a scale of 100 these are more than 10^5 rays.
    const std::uint64_t count = scaled_share(100);
    Rational worst_t = 0, worst_weight = 0;
    std::uint64_t hits = 0;
    ask_each<QueryMaker>(small_test_blobs(), 400, count, [&](const TestBlob& blob, QueryMaker& maker, std::uint64_t) {
        Ray ray = maker.any_ray();
        if (maker.random().below(3) == 0) maker.restrict(ray);
        CAPTURE(describe(ray));
        detail::LatticeRay rounded;
        const RayHit closest = raycast(blob.opened.blob, ray);
        const bool found = bool(closest);
        if (!detail::round_ray(detail::data_of(blob.opened.blob), ray, rounded)) {
            REQUIRE_FALSE(found);
            return;
        }
        const std::vector<ExactHit> exact = exact_hits(blob.decoded, rounded, ray.culling);
        REQUIRE(found == !exact.empty());
        REQUIRE(occluded(blob.opened.blob, ray).yes() == found);
        const std::vector<RayHit> every = every_hit(blob.opened.blob, ray);
        REQUIRE(every.size() == exact.size());
        for (std::size_t k = 0; k < every.size(); ++k) {
            const RayHit& hit = every[k];
            const oracle::Crossing& expected = exact[k].crossing;
            REQUIRE(hit.triangle.index == exact[k].index);
            REQUIRE(hit.status == QueryStatus::ok);
            REQUIRE(hit.side == (expected.front ? Side::front : Side::back));
            const Rational t = exact_t(rounded, expected.t);
            if (std::isinf(hit.t)) {
                REQUIRE(t > Rational::of(std::numeric_limits<float>::max()));  // where float32 ends
            } else {
                worst_t = std::max(worst_t, oracle::error_in_ulp(hit.t, t));
            }
            worst_weight = std::max(
                {worst_weight, oracle::error_in_ulp(hit.u, expected.u), oracle::error_in_ulp(hit.v, expected.v)});
            if (hit.triangle == closest.triangle) REQUIRE(same_bits(hit, closest));
            REQUIRE(closest.t <= hit.t);
        }
        hits += every.size();
    });
    CHECK(worst_t <= Rational(4));
    CHECK(worst_weight <= Rational(4));
    CHECK(hits > count);
}

}  // namespace
}  // namespace espalier::tests::every_hit_test
