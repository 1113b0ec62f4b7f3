// Claims about the closest points of a segment or a box and the surface, as the header words them.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include <espalier/nearest.hpp>
#include <espalier/overlap.hpp>
#include <runtime/closest_pair.hpp>
#include <runtime/lattice_round.hpp>

#include "support/base/calls.hpp"
#include "support/base/same_bits.hpp"
#include "support/base/test_scale.hpp"
#include "support/blobs/test_blobs.hpp"
#include "support/loops/triangle_loop.hpp"
#include "support/meshes/makers.hpp"
#include "support/meshes/real_meshes.hpp"
#include "support/queries/shape_maker.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

Vec3 sum(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 difference(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
double length(Vec3 a) {
    return std::hypot(static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z));
}

/// What the walk finds and what the loop finds.
template <class Shape>
bool equals_loop(const TestBlob& blob, const TriangleLoop& loop, Shape& shape, float max_distance,
                 const NearestPair& pair) {
    prepare(shape);
    shape.radius = detail::radius_in_steps(blob.opened.blob.data(), max_distance);
    const std::optional<detail::FoundPair> expected = loop.closest_pair(shape);
    detail::FoundPair found;
    if (detail::closest_pair(blob.opened.blob.data(), shape, found) != expected.has_value()) return false;
    if (!expected) return pair.triangle == no_triangle;
    return pair.triangle.index == expected->index && found.index == expected->index &&
           same_bits(found.distance.squared, expected->distance.squared) &&
           same_bits(found.distance.along, expected->distance.along) &&
           same_bits(found.distance.u, expected->distance.u) && same_bits(found.distance.v, expected->distance.v) &&
           same_bits(pair.u, expected->distance.u) && same_bits(pair.v, expected->distance.v);
}

struct Tally {
    std::uint64_t found = 0;
    std::uint64_t touching = 0;
    std::uint64_t nothing = 0;

    void count(const NearestPair& pair) {
        if (pair.triangle == no_triangle) ++nothing;
        else if (pair.distance == 0.0f) ++touching;
        else ++found;
    }
};

/// One segment and one box against the loop, and against the overlap queries, which go another way.
void check_one(const TestBlob& blob, const TriangleLoop& loop, ShapeMaker& maker, bool awkward, Tally& tally) {
    // Most shapes touch, as they are made for overlaps: half of them are moved away.
    const Vec3 off = maker.random().coin() ? Vec3{} : maker.random().in_cube(maker.size());
    Capsule capsule = maker.capsule(awkward);
    capsule.from = sum(capsule.from, off);
    capsule.to = sum(capsule.to, off);
    capsule.radius = std::fabs(capsule.radius);
    if (maker.random().below(3) == 0) capsule.radius = infinity;
    CAPTURE(describe(capsule));
    const Segment segment = {capsule.from, capsule.to};
    NearestPair pair;
    detail::DistantSegment distant;
    const QueryStatus status = closest_to_segment(blob.opened.blob, segment, capsule.radius, pair);
    REQUIRE(status == detail::round_segment(blob.opened.blob.data(), segment, distant.segment));
    if (status == QueryStatus::ok) {
        REQUIRE(equals_loop(blob, loop, distant, capsule.radius, pair));
        REQUIRE(overlaps(blob.opened.blob, capsule) == (pair.triangle != no_triangle));
        tally.count(pair);
    }

    Box box = maker.box(awkward);
    box.min = sum(box.min, off);
    box.max = sum(box.max, off);
    CAPTURE(describe(box));
    const float max_distance = maker.random().below(3) == 0 ? 0.0f : capsule.radius;
    detail::DistantBox distant_box;
    const QueryStatus box_status = closest_to_box(blob.opened.blob, box, max_distance, pair);
    REQUIRE(box_status == detail::round_segment(blob.opened.blob.data(), {box.min, box.max}, distant_box.diagonal));
    if (box_status != QueryStatus::ok) return;
    const auto is_above = [](float a, float b) { return detail::flush_subnormal(a) > detail::flush_subnormal(b); };
    if (is_above(box.min.x, box.max.x) || is_above(box.min.y, box.max.y) || is_above(box.min.z, box.max.z)) {
        REQUIRE(pair.triangle == no_triangle);
        return;
    }
    REQUIRE(equals_loop(blob, loop, distant_box, max_distance, pair));
    if (max_distance == 0.0f && distant_box.diagonal.fraction_bits == 6)
        REQUIRE(overlaps(blob.opened.blob, box) == (pair.triangle != no_triangle));
    tally.count(pair);
}

void tell_calls(const std::string& mesh, std::uint64_t random, std::uint64_t awkward) {
    MESSAGE(calls_made("distance: closest to a segment", mesh, random, awkward));
    MESSAGE(calls_made("distance: closest to a box", mesh, random, awkward));
}

void check(const std::vector<TestBlob>& blobs, std::uint64_t count) {
    Tally tally;
    for (const TestBlob& blob : blobs) {
        CAPTURE(blob.name);
        const TriangleLoop loop(blob.decoded);
        ShapeMaker maker(blob.decoded, 1400);
        for (std::uint64_t i = 0; i < count; ++i) check_one(blob, loop, maker, i % 2 == 0, tally);
    }
    tell_calls(generated_meshes, blobs.size() * (count / 2), blobs.size() * ((count + 1) / 2));
    if (!asks_enough()) return;
    CHECK(tally.found > blobs.size() * count / 20);
    CHECK(tally.touching > blobs.size() * count / 10);
    CHECK(tally.nothing > blobs.size() * count / 10);
}

}  // namespace

TEST_SUITE("closest pair") {
    TEST_CASE("closest point: segments and boxes equal the loop and agree with overlaps") {
        check(small_test_blobs(), scaled_share(100));
        check(medium_test_blobs(), scaled_share(12));
    }

    TEST_CASE("closest point: segments and boxes equal the loop on real meshes") {
        for_each_real_mesh([](const Mesh& mesh, format::Profile profile) {
            OpenedBlob opened(mesh, with_profile(profile));
            DecodedBlob decoded = decode(opened.bytes);
            const TestBlob blob = {mesh.name, std::move(opened), std::move(decoded)};
            const TriangleLoop loop(blob.decoded);
            ShapeMaker maker(blob.decoded, 1500 + static_cast<std::uint64_t>(profile));
            Tally tally;
            // Times a scale of 1,000 these are at least the counts that a release must show, all profiles together.
            const std::uint64_t count = scaled_share(blob.decoded.triangles.size() > 200'000 ? 3 : 112);
            for (std::uint64_t i = 0; i < count; ++i) check_one(blob, loop, maker, i % 10 == 9, tally);
            tell_calls(mesh.name, count - count / 10, count / 10);
            if (count >= 20) CHECK(tally.found > 0);
        });
    }
}

TEST_SUITE("closest pair") {
    TEST_CASE("closest point: a cube and a segment match hand-computed values") {
        const OpenedBlob cube(make_cube(-1.0f, 1.0f));
        NearestPair pair;
        // Above a face, across a side, past a corner, through the cube, and one end inside.
        REQUIRE(closest_to_segment(cube.blob, {{0.25f, 0.5f, 3.0f}, {0.25f, 0.5f, 9.0f}}, infinity, pair) ==
                QueryStatus::ok);
        CHECK(pair.on_shape == Vec3{0.25f, 0.5f, 3.0f});
        CHECK(pair.on_surface == Vec3{0.25f, 0.5f, 1.0f});
        CHECK(pair.distance == 2.0f);
        REQUIRE(closest_to_segment(cube.blob, {{4.0f, 0.0f, 5.0f}, {4.0f, 10.0f, 5.0f}}, infinity, pair) ==
                QueryStatus::ok);
        CHECK(pair.distance == 5.0f);
        CHECK(pair.on_surface.x == 1.0f);
        CHECK(pair.on_surface.z == 1.0f);
        CHECK(pair.on_shape.y == pair.on_surface.y);
        REQUIRE(closest_to_segment(cube.blob, {{4.0f, 4.0f, 1.0f}, {4.0f, 4.0f, 30.0f}}, infinity, pair) ==
                QueryStatus::ok);
        CHECK(pair.on_surface == Vec3{1.0f, 1.0f, 1.0f});
        CHECK(pair.on_shape == Vec3{4.0f, 4.0f, 1.0f});
        REQUIRE(closest_to_segment(cube.blob, {{0.25f, 0.5f, -3.0f}, {0.25f, 0.5f, 3.0f}}, infinity, pair) ==
                QueryStatus::ok);
        CHECK(pair.distance == 0.0f);
        CHECK(pair.on_shape == pair.on_surface);
        REQUIRE(closest_to_segment(cube.blob, {{0.0f, 0.0f, 0.0f}, {0.5f, 0.0f, 0.0f}}, infinity, pair) ==
                QueryStatus::ok);
        CHECK(pair.distance == 0.5f);
        REQUIRE(closest_to_segment(cube.blob, {{4.0f, 5.0f, 13.0f}, {4.0f, 5.0f, 13.0f}}, infinity, pair) ==
                QueryStatus::ok);
        CHECK(pair.distance == 13.0f);
    }

    TEST_CASE("closest point: a cube and a box match hand-computed values") {
        const OpenedBlob cube(make_cube(-1.0f, 1.0f));
        NearestPair pair;
        REQUIRE(closest_to_box(cube.blob, {{4.0f, 5.0f, 13.0f}, {5.0f, 6.0f, 14.0f}}, infinity, pair) ==
                QueryStatus::ok);
        CHECK(pair.on_shape == Vec3{4.0f, 5.0f, 13.0f});
        CHECK(pair.on_surface == Vec3{1.0f, 1.0f, 1.0f});
        CHECK(pair.distance == 13.0f);
        // Around all of the cube, touching it, and within it: a box is all that is in it, a surface is not.
        REQUIRE(closest_to_box(cube.blob, {{-9.0f, -9.0f, -9.0f}, {9.0f, 9.0f, 9.0f}}, 0.0f, pair) == QueryStatus::ok);
        CHECK(pair.distance == 0.0f);
        CHECK(pair.triangle.index == 0);
        REQUIRE(closest_to_box(cube.blob, {{1.0f, 0.0f, 0.0f}, {2.0f, 0.5f, 0.5f}}, 0.0f, pair) == QueryStatus::ok);
        CHECK(pair.distance == 0.0f);
        CHECK(pair.on_shape == pair.on_surface);
        REQUIRE(closest_to_box(cube.blob, {{-0.25f, -0.5f, -0.5f}, {0.75f, 0.5f, 0.5f}}, infinity, pair) ==
                QueryStatus::ok);
        CHECK(pair.distance == 0.25f);
        CHECK(pair.on_surface.x == 1.0f);
    }

    TEST_CASE("closest point: the two points are as far apart as the distance within some ulp") {
        for (const TestBlob& blob : small_test_blobs()) {
            CAPTURE(blob.name);
            ShapeMaker maker(blob.decoded, 1600);
            const Blob& opened = blob.opened.blob;
            for (std::uint64_t i = 0; i < scaled_share(100); ++i) {
                const Capsule capsule = maker.capsule(i % 2 == 0);
                const Box box = maker.box(i % 2 == 0);
                const auto check_pair = [&](const NearestPair& pair, Vec3 from, Vec3 to) {
                    double largest = 0.0;
                    for (const Vec3& v : {from, to, opened.bounds_min(), opened.bounds_max()})
                        largest = std::max({largest, std::fabs(static_cast<double>(v.x)),
                                            std::fabs(static_cast<double>(v.y)), std::fabs(static_cast<double>(v.z))});
                    // The shape is rounded to the lattice's grid too.
                    const double slack = largest * 28.0 * 0x1p-23 + static_cast<double>(opened.step()) * 0x1p-5;
                    REQUIRE(std::fabs(length(difference(pair.on_shape, pair.on_surface)) -
                                      static_cast<double>(pair.distance)) <= slack);
                    const double low = std::min(static_cast<double>(from.x), static_cast<double>(to.x)) - slack;
                    const double high = std::max(static_cast<double>(from.x), static_cast<double>(to.x)) + slack;
                    REQUIRE(static_cast<double>(pair.on_shape.x) >= low);
                    REQUIRE(static_cast<double>(pair.on_shape.x) <= high);
                };
                NearestPair pair;
                CAPTURE(describe(capsule));
                if (closest_to_segment(opened, {capsule.from, capsule.to}, infinity, pair) == QueryStatus::ok)
                    check_pair(pair, capsule.from, capsule.to);
                CAPTURE(describe(box));
                if (closest_to_box(opened, box, infinity, pair) == QueryStatus::ok && pair.triangle != no_triangle)
                    check_pair(pair, box.min, box.max);
            }
        }
    }

    TEST_CASE("closest point: shapes out of range are refused and leave the result untouched") {
        const OpenedBlob cube(make_cube(-1.0f, 1.0f));
        const float nan = std::numeric_limits<float>::quiet_NaN();
        const NearestPair before{{1.0f, 2.0f, 3.0f}, {4.0f, 5.0f, 6.0f}, 7.0f, 0.5f, 0.25f, Triangle{7}};
        NearestPair pair = before;
        const Vec3 near{2.0f, 0.0f, 0.0f};
        const Vec3 far{1e30f, 0.0f, 0.0f};
        CHECK(closest_to_segment(cube.blob, {near, {nan, 0.0f, 0.0f}}, 1.0f, pair) == QueryStatus::invalid_argument);
        CHECK(closest_to_segment(cube.blob, {near, {0.0f, infinity, 0.0f}}, 1.0f, pair) ==
              QueryStatus::invalid_argument);
        CHECK(closest_to_segment(cube.blob, {near, near}, nan, pair) == QueryStatus::invalid_argument);
        CHECK(closest_to_segment(cube.blob, {near, near}, -1.0f, pair) == QueryStatus::invalid_argument);
        CHECK(closest_to_segment(cube.blob, {near, far}, infinity, pair) == QueryStatus::out_of_range);
        CHECK(closest_to_box(cube.blob, {near, {nan, 0.0f, 0.0f}}, 1.0f, pair) == QueryStatus::invalid_argument);
        CHECK(closest_to_box(cube.blob, {near, near}, -infinity, pair) == QueryStatus::invalid_argument);
        CHECK(closest_to_box(cube.blob, {near, far}, infinity, pair) == QueryStatus::out_of_range);
        CHECK(same_bits(pair, before));
        CHECK(closest_to_segment(cube.blob, {near, near}, 0.5f, pair) == QueryStatus::ok);
        CHECK(pair.triangle == no_triangle);
        CHECK(pair.distance == 0.5f);
        CHECK(closest_to_box(cube.blob, {{1.0f, 1.0f, 1.0f}, {0.0f, 1.0f, 1.0f}}, infinity, pair) == QueryStatus::ok);
        CHECK(pair.triangle == no_triangle);
        CHECK(closest_to_box(Blob(), {near, near}, infinity, pair) == QueryStatus::ok);
        CHECK(pair.triangle == no_triangle);
        CHECK(closest_to_segment(Blob(), {near, near}, infinity, pair) == QueryStatus::ok);
        CHECK(pair.triangle == no_triangle);
    }
}
