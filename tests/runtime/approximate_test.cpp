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

#include "../support/test_scale.hpp"
#include "../support/instruction_paths.hpp"
#include "../support/mesh_files.hpp"
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
        if (!asks_enough()) return;
        CHECK(yes > 0);
        CHECK(wrong_yes > 0);
        CHECK(no > 0);
    }
};

using Check = void (*)(const Blob& blob, ShapeMaker& maker, QueryMaker& queries, bool awkward, Tally& tally);

void check_sphere(const Blob& blob, ShapeMaker& maker, QueryMaker& queries, bool awkward, Tally& tally) {
    const Sphere sphere = awkward ? queries.sphere() : queries.random_sphere();
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
}

void check_box(const Blob& blob, ShapeMaker& maker, QueryMaker&, bool awkward, Tally& tally) {
    const Box box = maker.box(awkward);
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
}

void check_ray(const Blob& blob, ShapeMaker& maker, QueryMaker& queries, bool awkward, Tally& tally) {
    Ray ray = awkward ? queries.any_ray() : queries.ray(RayKind::incoherent);
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
}

void check_bounds(const Blob& blob, ShapeMaker& maker, QueryMaker& queries, bool awkward, Tally& tally) {
    const Sphere sphere = awkward ? queries.sphere() : queries.random_sphere();
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
    tally.add(true, bounds.upper <= bounds.lower * 1.01f);
}

void check_instruction_sets(const Blob& blob, ShapeMaker& maker, QueryMaker& queries, bool awkward, Tally&) {
    const Sphere sphere = awkward ? queries.sphere() : queries.random_sphere();
    const Ray ray = awkward ? queries.any_ray() : queries.ray(RayKind::incoherent);
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
}

Tally check_test_blobs(Check check, std::uint64_t seed, std::uint64_t count) {
    Tally tally;
    for (const std::vector<TestBlob>* blobs : {&small_test_blobs(), &medium_test_blobs()}) {
        for (const TestBlob& blob : *blobs) {
            CAPTURE(blob.name);
            ShapeMaker maker(blob.decoded, seed);
            QueryMaker queries(blob.decoded, seed);
            for (std::uint64_t i = 0; i < count; ++i)
                check(blob.opened.blob, maker, queries, maker.random().coin(), tally);
        }
    }
    return tally;
}

/// Times a scale of 1,000 these are at least the counts that a release must show, all profiles together.
void check_real_mesh(const Mesh& mesh, format::Profile profile) {
    const OpenedBlob opened(mesh, with_profile(profile));
    const DecodedBlob decoded = decode(opened.bytes);
    ShapeMaker maker(decoded, 86 + static_cast<std::uint64_t>(profile));
    QueryMaker queries(decoded, 86 + static_cast<std::uint64_t>(profile));
    const std::uint64_t count = scaled_share(112);
    for (const Check check : {check_sphere, check_box, check_ray, check_bounds, check_instruction_sets}) {
        Tally tally;
        for (std::uint64_t i = 0; i < count; ++i) check(opened.blob, maker, queries, i % 10 == 9, tally);
    }
    MESSAGE(mesh.name, ", profile ", name_of(profile), ": ", count - count / 10, " random and ", count / 10,
            " awkward calls of each kind keep to the exact answers");
}

}  // namespace

TEST_SUITE("approximate queries") {
    TEST_CASE("spheres: no overlap is missed, and a wrong yes is within accuracy times the root of 3") {
        check_test_blobs(check_sphere, 81, scaled_share(300)).check();
    }
    TEST_CASE("boxes: no overlap is missed, and a wrong yes is within the accuracy along every axis") {
        check_test_blobs(check_box, 82, scaled_share(300)).check();
    }
    TEST_CASE("rays: no hit is missed, and a wrong yes passes within accuracy times the root of 3") {
        check_test_blobs(check_ray, 83, scaled_share(300)).check();
    }
    TEST_CASE("bounds hold the distance between them, and are no farther apart than accuracy times the root of 3") {
        CHECK(check_test_blobs(check_bounds, 84, scaled_share(300)).wrong_yes > 0);  // some are apart
    }
    TEST_CASE("every instruction set answers the same and does the same work") {
        check_test_blobs(check_instruction_sets, 85, scaled_share(60));
    }
    TEST_CASE("real meshes: all of these claims") {
        const auto files = mesh_files();
        if (files.empty()) {
            MESSAGE("SKIPPED: no .obj or .ply file in the folder ESPALIER_MESHES");
            return;
        }
        for (const auto& file : files) {
            const Mesh mesh = read_mesh(file);
            CAPTURE(mesh.name);
            if (mesh.triangles.size() > 200'000) continue;  // baking it takes longer than asking it
            for_each_profile([&](format::Profile profile) { check_real_mesh(mesh, profile); });
        }
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
