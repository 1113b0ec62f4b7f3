// Claims about the first few hits of a ray and about segments; that they equal the loop, traversal_test.cpp shows.
#include "support/testing.hpp"

#include "support/answers/differences.hpp"

namespace espalier::tests::closest_hits_test {
namespace {

/// A vertical ray through two cubes, one in the other: four faces.
struct NestedCubes {
    NestedCubes(Profile profile)
        : opened(joined(make_cube(-2.0f, 2.0f), make_cube(-1.0f, 1.0f)), with_profile(profile)) {}
    OpenedBlob opened;
    Ray down = {.origin = {0.25f, 0.5f, 4.0f}, .direction = {0.0f, 0.0f, -1.0f}};
};

TEST_CASE("ray: the first hits are sorted and the status reports more") {
    for_each_profile([](Profile profile) {
        const NestedCubes cubes(profile);
        constexpr std::array<double, 4> expected = {2.0, 3.0, 5.0, 6.0};
        for (std::size_t places = 0; places <= 6; ++places) {
            CAPTURE(places);
            std::vector<RayHit> hits(places);
            const Filled found = closest_hits(cubes.opened.blob, cubes.down, hits);
            CHECK(found.count == std::min<std::size_t>(places, 4));
            CHECK(found.status == (places < 4 ? QueryStatus::output_full : QueryStatus::ok));
            for (std::size_t i = 0; i < found.count; ++i) {
                CHECK(hits[i].t == doctest::Approx(expected[i]));
                CHECK(hits[i].status == QueryStatus::ok);
                CHECK(hits[i].side == (i < 2 ? Side::front : Side::back));
            }
        }
    });
}

TEST_CASE("ray: the first of the first hits is the closest hit and unused slots stay untouched") {
    const NestedCubes cubes(Profile::fast);
    const RayHit single = raycast(cubes.opened.blob, cubes.down);
    std::array<RayHit, 1> one;
    REQUIRE(single);
    REQUIRE(closest_hits(cubes.opened.blob, cubes.down, one).count == 1);
    CHECK(same_bits(one[0], single));
    Ray up = cubes.down;
    up.direction.z = 1.0f;
    const Filled nothing = closest_hits(cubes.opened.blob, up, one);
    CHECK(nothing.count == 0);
    CHECK(nothing.status == QueryStatus::ok);
    CHECK(same_bits(one[0], single));
    CHECK(closest_hits(cubes.opened.blob, up, {}).status == QueryStatus::ok);
    CHECK(closest_hits(Blob(), cubes.down, one).count == 0);
    CHECK(closest_hits(Blob(), cubes.down, one).status == QueryStatus::not_open);
    up.origin.x = not_a_number;
    CHECK(closest_hits(cubes.opened.blob, up, one).count == 0);
    CHECK(closest_hits(cubes.opened.blob, up, one).status == QueryStatus::invalid_argument);
}

TEST_CASE("ray: a triangle with copies appears once and rays and spheres equal the loop") {
    const OpenedBlob opened(make_soup(400, 3), with_copies());
    REQUIRE(opened.blob.duplicate_reference_count() > 0);
    const DecodedBlob decoded = decode(opened.bytes);
    const TriangleLoop loop(decoded);
    QueryMaker maker(decoded, 403);
    std::uint64_t hits = 0, touched = 0;
    for (std::uint64_t i = 0; i < scaled(2000); ++i) {
        require_none(ray_difference(opened.blob, loop, maker.any_ray(), hits));
        if (i % 4 == 0) require_none(sphere_difference(opened.blob, loop, maker.sphere(), touched));
    }
    if (!asks_enough()) return;
    CHECK(hits > 1000);
    CHECK(touched > 1000);
}

TEST_CASE("ray: a segment hits between its ends and at them") {
    for_each_profile([](Profile profile) {
        const OpenedBlob cube(make_cube(-1.0f, 1.0f), with_profile(profile));
        const auto hits = [&](float from, float to) {
            const Ray segment = Ray::between({0.25f, 0.5f, from}, {0.25f, 0.5f, to});
            const RayHit hit = raycast(cube.blob, segment);
            CHECK(occluded(cube.blob, segment).status() == hit.status);
            if (hit) CHECK(std::fabs(from + hit.t * (to - from)) == doctest::Approx(1.0));
            return bool(hit);
        };
        CHECK(hits(3.0f, 0.0f));
        CHECK(hits(3.0f, 1.0f));
        CHECK(hits(1.0f, 3.0f));
        CHECK_FALSE(hits(3.0f, 1.001f));
        CHECK_FALSE(hits(0.9f, -0.9f));
        CHECK_FALSE(hits(2.0f, 2.0f));
    });
}

TEST_CASE("ray: a ray between two points has their difference as direction and a window from 0 to 1") {
    ask_each<QueryMaker>(small_test_blobs(), 404, scaled_share(60),
                         [&](const TestBlob& blob, QueryMaker& maker, std::uint64_t) {
                             const Ray ray = maker.any_ray();
                             const Vec3 from = ray.origin, to = sum(from, ray.direction);
                             const RayHit of_segment = raycast(blob.opened.blob, Ray::between(from, to));
                             const Ray same = {from, difference(to, from), 0.0f, 1.0f};
                             REQUIRE(same_bits(of_segment, raycast(blob.opened.blob, same)));
                             REQUIRE((!of_segment || of_segment.t <= 1.0f));
                             REQUIRE(occluded(blob.opened.blob, Ray::between(from, to)).status() == of_segment.status);
                         });
}

TEST_CASE("ray: a ray between points that are not finite or the same or too far apart is refused") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    constexpr float most = std::numeric_limits<float>::max();
    const auto status = [&](const Vec3& from, const Vec3& to) {
        return occluded(cube.blob, Ray::between(from, to)).status();
    };
    CHECK(status({not_a_number, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}) == QueryStatus::invalid_argument);
    CHECK(status({0.0f, 0.0f, 0.0f}, {0.0f, not_a_number, 0.0f}) == QueryStatus::invalid_argument);
    CHECK(status({-most, 0.0f, 0.0f}, {most, 0.0f, 0.0f}) == QueryStatus::invalid_argument);
    CHECK(status({2.0f, 0.0f, 0.0f}, {2.0f, 0.0f, 0.0f}) == QueryStatus::invalid_argument);
}

}  // namespace
}  // namespace espalier::tests::closest_hits_test
