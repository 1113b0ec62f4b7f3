// Claims about queries that stop at small boxes: nothing is missed, and how wrong a yes can be.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include <espalier/approximate.hpp>
#include <espalier/nearest.hpp>
#include <espalier/overlap.hpp>
#include <runtime/lattice_point.hpp>
#include <runtime/small_boxes.hpp>

#include "../support/instruction_paths.hpp"
#include "../support/mesh_makers.hpp"
#include "../support/profiles.hpp"
#include "../support/query_maker.hpp"
#include "../support/shape_maker.hpp"
#include "../support/test_blobs.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float root_of_3 = 1.7320509f;

/// From below a step to all of the asset.
float some_accuracy(ShapeMaker& maker) {
    return std::ldexp(maker.size() * maker.random().unit(), -maker.random().between(0, 10));
}

/// What rounding a query may move it by, in world units, and more.
float moved(const Blob& blob, Vec3 at) {
    return blob.step() +
           std::ldexp(std::fabs(at.x) + std::fabs(at.y) + std::fabs(at.z) + std::fabs(blob.bounds_max().x) +
                          std::fabs(blob.bounds_max().y) + std::fabs(blob.bounds_max().z),
                      -20);
}

struct Tally {
    std::uint64_t yes = 0;
    std::uint64_t wrong_yes = 0;
    std::uint64_t no = 0;
    void add(bool maybe, bool exact) { ++(!maybe ? no : exact ? yes : wrong_yes); }
    void check() const {
        CHECK(yes > 0);
        CHECK(wrong_yes > 0);
        CHECK(no > 0);
    }
};

template <class Call>
void for_each_blob(std::uint64_t seed, std::uint64_t count, Call call) {
    for (const std::vector<TestBlob>* blobs : {&small_test_blobs(), &medium_test_blobs()}) {
        for (const TestBlob& blob : *blobs) {
            CAPTURE(blob.name);
            ShapeMaker maker(blob.decoded, seed);
            QueryMaker rays(blob.decoded, seed);
            for (std::uint64_t i = 0; i < count; ++i) call(blob.opened.blob, maker, rays);
        }
    }
}

}  // namespace

TEST_SUITE("approximate queries") {
    TEST_CASE("spheres: no overlap is missed, and a wrong yes is within accuracy times the root of 3") {
        Tally tally;
        for_each_blob(81, scaled_share(300), [&](const Blob& blob, ShapeMaker& maker, QueryMaker& queries) {
            const Sphere sphere = queries.sphere();
            const float accuracy = some_accuracy(maker);
            CAPTURE(describe(sphere));
            CAPTURE(accuracy);
            const bool exact = overlaps(blob, sphere);
            const bool maybe = may_overlap(blob, sphere, accuracy);
            if (exact) REQUIRE(maybe);
            if (maybe && !exact) {
                const float more = sphere.radius * 0x1p-18f + moved(blob, sphere.center);
                REQUIRE(overlaps(blob, Sphere{sphere.center, sphere.radius + accuracy * root_of_3 + more}));
            }
            REQUIRE(may_overlap(blob, sphere, 0.0f) == exact);
            tally.add(maybe, exact);
        });
        tally.check();
    }

    TEST_CASE("boxes: no overlap is missed, and a wrong yes is within the accuracy along every axis") {
        Tally tally;
        for_each_blob(82, scaled_share(300), [&](const Blob& blob, ShapeMaker& maker, QueryMaker&) {
            const Box box = maker.box(maker.random().coin());
            const float accuracy = some_accuracy(maker);
            CAPTURE(describe(box));
            CAPTURE(accuracy);
            const bool exact = overlaps(blob, box);
            const bool maybe = may_overlap(blob, box, accuracy);
            if (exact) REQUIRE(maybe);
            if (maybe && !exact) {
                const float more = accuracy + moved(blob, box.max) + moved(blob, {});
                REQUIRE(overlaps(blob, Box{{box.min.x - more, box.min.y - more, box.min.z - more},
                                           {box.max.x + more, box.max.y + more, box.max.z + more}}));
            }
            REQUIRE(may_overlap(blob, box, 0.0f) == exact);
            tally.add(maybe, exact);
        });
        tally.check();
    }

    TEST_CASE("rays: no hit is missed, and a wrong yes passes within accuracy times the root of 3") {
        Tally tally;
        for_each_blob(83, scaled_share(300), [&](const Blob& blob, ShapeMaker& maker, QueryMaker& queries) {
            Ray ray = queries.any_ray();
            if (maker.random().coin()) queries.restrict(ray);
            ray.faces = Faces::both;
            const float accuracy = some_accuracy(maker);
            CAPTURE(describe(ray));
            CAPTURE(accuracy);
            const bool exact = occluded(blob, ray);
            const bool maybe = may_be_occluded(blob, ray, accuracy);
            if (exact) REQUIRE(maybe);
            REQUIRE(may_be_occluded(blob, ray, 0.0f) == exact);
            tally.add(maybe, exact);
            const float length = std::sqrt(ray.direction.x * ray.direction.x + ray.direction.y * ray.direction.y +
                                           ray.direction.z * ray.direction.z);
            const float reach = 1e3f * maker.size();
            if (maybe && !exact && length > 0x1p-60f && length < 0x1p60f) {
                const float first = std::fmax(ray.t_min, 0.0f), last = std::fmin(ray.t_max, first + reach / length);
                const auto at = [&](float t) {
                    return Vec3{ray.origin.x + t * ray.direction.x, ray.origin.y + t * ray.direction.y,
                                ray.origin.z + t * ray.direction.z};
                };
                const float more = 4.0f * (moved(blob, ray.origin) + moved(blob, at(last)));
                Triangle room[1];
                const OverlapPage page =
                    collect_overlaps(blob, Capsule{at(first), at(last), accuracy * root_of_3 + more}, room);
                const bool is_long_enough = first * length < reach && last >= ray.t_max;
                if (page.status != QueryStatus::out_of_range && (is_long_enough || more < accuracy))
                    REQUIRE((page.count > 0 || last < ray.t_max));
            }
        });
        tally.check();
    }

    TEST_CASE("bounds hold the distance between them, and are no farther apart than accuracy times the root of 3") {
        std::uint64_t apart = 0;
        for_each_blob(84, scaled_share(300), [&](const Blob& blob, ShapeMaker& maker, QueryMaker& queries) {
            const Sphere sphere = queries.sphere();
            const float accuracy = maker.random().below(4) == 0 ? 0.0f : some_accuracy(maker);
            CAPTURE(describe(sphere));
            CAPTURE(accuracy);
            Nearest nearest;
            DistanceBounds bounds;
            const bool found = closest_point(blob, sphere.center, sphere.radius, nearest);
            const bool has_bounds = distance_bounds(blob, sphere.center, sphere.radius, accuracy, bounds);
            if (found) REQUIRE(has_bounds);
            if (!has_bounds) return;
            REQUIRE(bounds.lower <= sphere.radius);
            REQUIRE(bounds.lower <= bounds.upper);
            REQUIRE(bounds.upper <= bounds.lower + accuracy * root_of_3 + bounds.upper * 0x1p-16f);
            if (accuracy == 0.0f) REQUIRE(found);
            if (!found) return;
            REQUIRE(bounds.lower <= nearest.distance);
            REQUIRE(nearest.distance <= bounds.upper);
            apart += bounds.upper > bounds.lower * 1.01f ? 1u : 0u;
        });
        CHECK(apart > 0);
    }

    TEST_CASE("every instruction set answers the same and does the same work") {
        for_each_blob(85, scaled_share(60), [&](const Blob& blob, ShapeMaker& maker, QueryMaker& queries) {
            const Sphere sphere = queries.sphere();
            const Ray ray = queries.any_ray();
            const std::int32_t steps = detail::steps_in(blob.data(), some_accuracy(maker));
            detail::LatticePoint rounded;
            if (!detail::round_point(blob.data(), sphere.center, sphere.radius, rounded)) return;
            QueryCounters first;
            const InstructionPath& scalar = instruction_paths().front();
            const bool overlap = scalar.may_overlap(blob.data(), rounded, steps, first);
            const detail::SquaredBounds bounds = scalar.closest_bounds(blob.data(), rounded, steps, first);
            const bool hit = scalar.may_hit(blob.data(), ray, steps, first);
            for (const InstructionPath& path : instruction_paths()) {
                QueryCounters counters;
                REQUIRE(path.may_overlap(blob.data(), rounded, steps, counters) == overlap);
                const detail::SquaredBounds again = path.closest_bounds(blob.data(), rounded, steps, counters);
                REQUIRE(again.lower == bounds.lower);
                REQUIRE(again.upper == bounds.upper);
                REQUIRE(path.may_hit(blob.data(), ray, steps, counters) == hit);
            }
        });
    }

    TEST_CASE("a coarse answer takes less work, and a NaN or negative accuracy is exact") {
        const OpenedBlob sphere(make_icosphere(5, 1.0, {0.0f, 0.0f, 0.0f}));
        const float nan = std::numeric_limits<float>::quiet_NaN();
        std::uint64_t before = ~std::uint64_t{0};
        for (const float accuracy : {0.0f, 0.5f, 1.5f, 4.0f}) {
            QueryCounters counters;
            DistanceBounds bounds;
            for (int i = 0; i < 100; ++i) {
                const auto angle = static_cast<float>(i);
                REQUIRE(distance_bounds(sphere.blob, {1.5f * std::sin(angle), 1.5f * std::cos(angle), 0.1f}, infinity,
                                        accuracy, bounds, &counters));
            }
            CHECK(counters.nodes < before);
            before = counters.nodes;
        }
        CHECK(before == 100);  // the root, once each
        const Sphere inside{{0.0f, 0.0f, 0.0f}, 0.5f};
        CHECK_FALSE(overlaps(sphere.blob, inside));
        CHECK_FALSE(may_overlap(sphere.blob, inside, nan));
        CHECK_FALSE(may_overlap(sphere.blob, inside, -1.0f));
        CHECK(may_overlap(sphere.blob, inside, infinity));
        CHECK_FALSE(may_overlap(sphere.blob, Sphere{{nan, 0.0f, 0.0f}, 1.0f}, 1.0f));
        CHECK_FALSE(may_overlap(sphere.blob, Sphere{{9.0f, 0.0f, 0.0f}, 1.0f}, infinity));
        CHECK_FALSE(may_overlap(Blob(), inside, infinity));
    }
}
