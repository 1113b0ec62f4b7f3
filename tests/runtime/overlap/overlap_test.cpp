// Claims about spheres against a surface as the header words them.
#include "support/testing.hpp"

#include "support/exact/as_rationals.hpp"

namespace espalier::tests::overlap_test {
namespace {

std::uint32_t count_overlaps(const Blob& blob, const Sphere& sphere) {
    std::uint32_t count = 0;
    CHECK(for_each_overlap(blob, sphere, [&](TriangleId) { ++count; }) == QueryStatus::ok);
    return count;
}

TEST_CASE("overlap: a sphere gives every overlapping triangle and no other") {
    const std::uint64_t count = std::max<std::uint64_t>(scaled_share(30), rounds_per_case(5));
    std::uint64_t overlapping = 0, seed = 700;
    for (const TestBlob& blob : small_test_blobs()) {
        CAPTURE(blob.name);
        QueryMaker maker(blob.decoded, seed++);
        for (std::uint64_t i = 0; i < count; ++i) {
            const Sphere sphere = maker.sphere();
            CAPTURE(describe(sphere));
            detail::RoundedPoint rounded;
            if (detail::round_point(detail::data_of(blob.opened.blob), sphere.center, sphere.radius, rounded) !=
                QueryStatus::ok) {
                REQUIRE(overlaps(blob.opened.blob, sphere).no());
                continue;
            }
            const oracle::Point center = exact_center(rounded);
            std::vector<std::uint32_t> expected;
            for (std::uint32_t index = 0; index < blob.decoded.triangles.size(); ++index) {
                const auto closest = oracle::closest_on_triangle(exact_triangle(blob.decoded.triangles[index]), center);
                const bool within =
                    std::isinf(rounded.radius) ||
                    closest.squared_distance <= Rational::of(rounded.radius) * Rational::of(rounded.radius);
                if (within) expected.push_back(index);
            }
            std::vector<std::uint32_t> actual;
            REQUIRE(for_each_overlap(blob.opened.blob, sphere, [&](TriangleId t) { actual.push_back(t.index); }) ==
                    QueryStatus::ok);
            REQUIRE(actual == expected);
            REQUIRE(overlaps(blob.opened.blob, sphere).yes() == !expected.empty());
            overlapping += expected.size();
        }
    }
    CHECK(overlapping > count);
}

TEST_CASE("overlap: touching a sphere counts to the last bit") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    CHECK(overlaps(cube.blob, Sphere{{0.25f, 0.5f, 3.0f}, 2.0f}).yes());
    CHECK(overlaps(cube.blob, Sphere{{0.25f, 0.5f, 3.0f}, std::nextafter(2.0f, 0.0f)}).no());
    // From a corner: 3, 4, 12 and 13.
    CHECK(overlaps(cube.blob, Sphere{{4.0f, 5.0f, 13.0f}, 13.0f}).yes());
    CHECK(overlaps(cube.blob, Sphere{{4.0f, 5.0f, 13.0f}, std::nextafter(13.0f, 0.0f)}).no());
}

TEST_CASE("overlap: a sphere inside a closed mesh that touches no triangle overlaps none") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    CHECK(overlaps(cube.blob, Sphere{{0.0f, 0.0f, 0.0f}, 0.875f}).no());
    CHECK(count_overlaps(cube.blob, Sphere{{0.0f, 0.0f, 0.0f}, 1.0f}) == 12);
}

TEST_CASE("overlap: radius 0 is a point and infinity is everything and a negative one or NaN nothing") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    CHECK(overlaps(cube.blob, Sphere{{0.25f, 0.5f, 1.0f}, 0.0f}).yes());
    CHECK(overlaps(cube.blob, Sphere{{0.25f, 0.5f, 1.0f}, -0.0f}).yes());
    CHECK(overlaps(cube.blob, Sphere{{0.25f, 0.5f, 1.5f}, 0.0f}).no());
    CHECK(count_overlaps(cube.blob, Sphere{{1e30f, 0.0f, 0.0f}, infinity}) == 12);
    CHECK(overlaps(cube.blob, Sphere{{0.0f, 0.0f, 1.0f}, -1.0f}).status() == QueryStatus::invalid_argument);
    CHECK(overlaps(cube.blob, Sphere{{0.0f, 0.0f, 1.0f}, not_a_number}).status() == QueryStatus::invalid_argument);
    CHECK(overlaps(cube.blob, Sphere{{0.0f, not_a_number, 1.0f}, 1.0f}).status() == QueryStatus::invalid_argument);
    CHECK(overlaps(cube.blob, Sphere{{0.0f, infinity, 1.0f}, infinity}).status() == QueryStatus::invalid_argument);
    CHECK(overlaps(Blob(), Sphere{{0.0f, 0.0f, 0.0f}, infinity}).status() == QueryStatus::not_open);
}

TEST_CASE("overlap: a visitor that stops is not called again and the status reports it") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    int calls = 0;
    const Sphere all{{0.0f, 0.0f, 0.0f}, 10.0f};
    CHECK(for_each_overlap(cube.blob, all, [&](TriangleId) { return ++calls == 5 ? Visit::stop : Visit::next; }) ==
          QueryStatus::stopped);
    CHECK(calls == 5);
}

}  // namespace
}  // namespace espalier::tests::overlap_test
