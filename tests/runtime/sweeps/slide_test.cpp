// Tests of sweeps that continue at a contact: how far a body must be moved away from it.
#include "support/testing.hpp"

namespace espalier::tests::slide_test {
namespace {

using tests::largest;
float largest(const Sphere& sphere) { return largest(sphere.center); }
float largest(const Capsule& capsule) { return std::max(largest(capsule.from), largest(capsule.to)); }
float largest(const Box& box) { return std::max(largest(box.min), largest(box.max)); }
float largest(const OrientedBox& box) { return largest(box.center); }

struct Seen {
    std::uint64_t contacts = 0;
    std::uint64_t overlapping = 0;  ///< without a push
    std::uint64_t kept = 0;         ///< away by a skin
};

/// Sweeps the shape, moves it away from the contact by the documented skin, and requires that it does not touch.
template <class Shape>
void slide(const Blob& blob, const Shape& start, const Vec3& way, const Vec3& next, Seen& seen) {
    const SweepHit hit = sweep(blob, start, way);
    if (!hit || hit.starts_overlapping) return;
    const Shape stopped = translated(start, times(way, hit.t));
    const auto only_it = [&](TriangleId triangle) { return triangle == hit.triangle; };
    ++seen.contacts;
    seen.overlapping += sweep(blob, stopped, next, only_it).starts_overlapping ? 1u : 0u;
    const Result<float> before = rounding_error(blob, start, way), after = rounding_error(blob, stopped, next);
    REQUIRE(before);
    REQUIRE(after);
    const float additions = 0x1p-21f * std::max(largest(start), largest(translated(start, way)));
    const float skin = before.value + after.value + additions;
    const Shape pushed = translated(stopped, times(hit.normal, skin));
    REQUIRE_FALSE(sweep(blob, pushed, next, only_it).starts_overlapping);
    // Or stopped as much earlier.
    const SweepHit kept = sweep(blob, start, way, SweepOptions{.skin = skin});
    REQUIRE(kept.triangle == hit.triangle);
    if (kept.t == 0.0f) return;
    ++seen.kept;
    REQUIRE_FALSE(sweep(blob, translated(start, times(way, kept.t)), next, only_it).starts_overlapping);
}

TEST_CASE("sweep: a body that keeps away by the bounds of both sweeps does not start in the contact") {
    for (const float offset : {0.0f, 1000.0f}) {
        for (const float coarseness : {0x1p-12f, 0x1p-4f}) {
            const BakeOptions options = {.resolution = Resolution::tolerance(static_cast<double>(coarseness))};
            const OpenedBlob opened(make_icosphere(3, 4.0, {offset, 0.0f, -offset}), options);
            const Blob& blob = opened.blob;
            Seen spheres, capsules, boxes, oriented;
            Random random(2680);
            for (std::uint64_t i = 0; i < scaled(4000); ++i) {
                const Vec3 off = random.in_cube(9.0f), to = random.in_cube(3.0f), next = random.in_cube(2.0f);
                const Vec3 a = {off.x + offset, off.y, off.z - offset};
                const Vec3 way = difference(to, off);
                const Vec3 b = translated(a, random.in_cube(1.0f));
                const float radius = random.unit();
                slide(blob, Sphere{a, radius}, way, next, spheres);
                slide(blob, Capsule{a, b, radius}, way, next, capsules);
                slide(blob, Box{a, translated(a, {radius, random.unit(), random.unit()})}, way, next, boxes);
                const OrientedBox turned = {a, {random.in_cube(1.0f), random.in_cube(1.0f), random.in_cube(1.0f)}};
                slide(blob, turned, way, next, oriented);
            }
            if (!asks_enough()) continue;
            for (const Seen& seen : {spheres, capsules, boxes, oriented}) {
                CHECK(seen.contacts > 100);
                CHECK(seen.overlapping > 0);
                CHECK(seen.kept > 100);
            }
        }
    }
}

}  // namespace
}  // namespace espalier::tests::slide_test
