// Claims about the first few hits of a ray and about segments; that they equal the loop, traversal_test.cpp shows.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <espalier/ray.hpp>

#include "support/answers/differences.hpp"
#include "support/base/profiles.hpp"
#include "support/base/same_bits.hpp"
#include "support/base/test_scale.hpp"
#include "support/blobs/test_blobs.hpp"
#include "support/meshes/makers.hpp"
#include "support/queries/ray_maker.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

/// A vertical ray through two cubes, one in the other: four faces.
struct NestedCubes {
    NestedCubes(format::Profile profile) : opened(mesh(), with_profile(profile)) {}
    static Mesh mesh() {
        Mesh both = make_cube(-2.0f, 2.0f);
        const Mesh inner = make_cube(-1.0f, 1.0f);
        const auto first = static_cast<std::uint32_t>(both.positions.size());
        both.positions.insert(both.positions.end(), inner.positions.begin(), inner.positions.end());
        for (TriangleVertices triangle : inner.triangles) {
            for (auto& vertex : triangle) vertex += first;
            both.triangles.push_back(triangle);
        }
        return both;
    }
    OpenedBlob opened;
    Ray down = {.origin = {0.25f, 0.5f, 4.0f}, .direction = {0.0f, 0.0f, -1.0f}};
};

}  // namespace

TEST_SUITE("closest hits") {
    TEST_CASE("ray: the first hits are sorted and the status reports more") {
        for_each_profile([](format::Profile profile) {
            const NestedCubes cubes(profile);
            constexpr std::array<double, 4> expected = {2.0, 3.0, 5.0, 6.0};
            for (std::size_t places = 0; places <= 6; ++places) {
                CAPTURE(places);
                std::vector<RayHit> hits(places);
                const HitCount found = closest_hits(cubes.opened.blob, cubes.down, hits);
                CHECK(found.count == std::min<std::size_t>(places, 4));
                CHECK(found.status == (places < 4 ? QueryStatus::output_full : QueryStatus::ok));
                for (std::size_t i = 0; i < found.count; ++i) CHECK(hits[i].t == doctest::Approx(expected[i]));
            }
        });
    }

    TEST_CASE("ray: the first of the first hits is the closest hit and unused slots stay untouched") {
        const NestedCubes cubes(format::Profile::fast);
        RayHit single;
        std::array<RayHit, 1> one;
        REQUIRE(raycast(cubes.opened.blob, cubes.down, single));
        REQUIRE(closest_hits(cubes.opened.blob, cubes.down, one).count == 1);
        CHECK(same_bits(one[0], single));
        Ray up = cubes.down;
        up.direction.z = 1.0f;
        const HitCount nothing = closest_hits(cubes.opened.blob, up, one);
        CHECK(nothing.count == 0);
        CHECK(nothing.status == QueryStatus::ok);
        CHECK(same_bits(one[0], single));
        CHECK(closest_hits(cubes.opened.blob, up, {}).status == QueryStatus::ok);
        CHECK(closest_hits(Blob(), cubes.down, one).count == 0);
        up.origin.x = std::numeric_limits<float>::quiet_NaN();
        CHECK(closest_hits(cubes.opened.blob, up, one).count == 0);
    }

    TEST_CASE("ray: a triangle with copies appears once and hits equal the loop") {
        BakeOptions options = with_profile(format::Profile::fast);
        options.builder = Builder::spatial_splits;
        options.duplicates = 1.0;
        const OpenedBlob opened(make_soup(400, 3), options);
        REQUIRE(opened.blob.copy_count() > 0);
        const DecodedBlob decoded = decode(opened.bytes);
        const TriangleLoop loop(decoded);
        QueryMaker maker(decoded, 403);
        std::uint64_t hits = 0;
        for (std::uint64_t i = 0; i < scaled(2000); ++i) {
            const auto difference = ray_difference(opened.blob, loop, maker.any_ray(), hits);
            REQUIRE_MESSAGE(!difference, *difference);
        }
        if (asks_enough()) CHECK(hits > 1000);
    }
}

TEST_SUITE("closest hits") {
    TEST_CASE("ray: a segment hits between its ends and at them") {
        for_each_profile([](format::Profile profile) {
            const OpenedBlob cube(make_cube(-1.0f, 1.0f), with_profile(profile));
            const auto hits = [&](float from, float to) {
                const Segment segment = {{0.25f, 0.5f, from}, {0.25f, 0.5f, to}};
                RayHit hit;
                const bool found = raycast(cube.blob, segment, hit);
                CHECK(occluded(cube.blob, segment) == found);
                if (found) CHECK(std::fabs(from + hit.t * (to - from)) == doctest::Approx(1.0));
                return found;
            };
            CHECK(hits(3.0f, 0.0f));
            CHECK(hits(3.0f, 1.0f));
            CHECK(hits(1.0f, 3.0f));
            CHECK_FALSE(hits(3.0f, 1.001f));
            CHECK_FALSE(hits(0.9f, -0.9f));
            CHECK_FALSE(hits(2.0f, 2.0f));
        });
    }

    TEST_CASE("ray: a segment equals the ray along it in every query") {
        for (const TestBlob& blob : small_test_blobs()) {
            CAPTURE(blob.name);
            QueryMaker maker(blob.decoded, 404);
            for (std::uint64_t i = 0; i < scaled_share(60); ++i) {
                const Ray ray = maker.any_ray();
                const Segment segment = {
                    ray.origin,
                    {ray.origin.x + ray.direction.x, ray.origin.y + ray.direction.y, ray.origin.z + ray.direction.z}};
                const Ray same = along(segment);
                RayHit of_segment;
                RayHit of_ray;
                const bool found = raycast(blob.opened.blob, segment, of_segment);
                REQUIRE(raycast(blob.opened.blob, same, of_ray) == found);
                REQUIRE(same_bits(of_segment, of_ray));
                REQUIRE((!found || of_segment.t <= 1.0f));
                REQUIRE(occluded(blob.opened.blob, segment) == found);
            }
        }
    }

    TEST_CASE("ray: a segment that is not finite or has no length hits nothing") {
        const OpenedBlob cube(make_cube(-1.0f, 1.0f));
        constexpr float nan = std::numeric_limits<float>::quiet_NaN();
        constexpr float most = std::numeric_limits<float>::max();
        CHECK_FALSE(occluded(cube.blob, Segment{{nan, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}}));
        CHECK_FALSE(occluded(cube.blob, Segment{{0.0f, 0.0f, 0.0f}, {0.0f, nan, 0.0f}}));
        CHECK_FALSE(occluded(cube.blob, Segment{{-most, 0.0f, 0.0f}, {most, 0.0f, 0.0f}}));
    }
}
