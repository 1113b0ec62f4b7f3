// Claims about the closest points of a segment or a box and the surface, as the header words them.
#include "support/testing.hpp"

#include <runtime/lattice/rounder.hpp>
#include <runtime/proximity/queries.hpp>

#include "support/exact/as_rationals.hpp"
#include "support/loops/triangle_loop.hpp"
#include "support/meshes/real_meshes.hpp"
#include "support/queries/shape_maker.hpp"

namespace espalier::tests::closest_pair_test {
namespace {

/// What the walk finds and what the loop finds.
template <class Shape>
bool equals_loop(const TestBlob& blob, const TriangleLoop& loop, Shape& shape, float max_distance,
                 const ClosestPoint& pair) {
    prepare(shape);
    shape.radius = detail::radius_in_steps(detail::data_of(blob.opened.blob), max_distance);
    const std::optional<detail::FoundPair> expected = loop.closest_pair(shape);
    detail::FoundPair found;
    detail::Closest<detail::FoundPair> closest(found);
    using namespace detail;
    ESPALIER_DISPATCH(find_nearest_pair, data_of(blob.opened.blob), shape, closest);
    if (closest.found() != expected.has_value()) return false;
    if (!expected) return pair.status == QueryStatus::not_found && pair.triangle == no_triangle;
    return pair.triangle.index == expected->index && found.index == expected->index &&
           same_bits(found.distance.squared, expected->distance.squared) &&
           same_bits(found.distance.along, expected->distance.along) &&
           same_bits(found.distance.u, expected->distance.u) && same_bits(found.distance.v, expected->distance.v) &&
           same_bits(pair.u, expected->distance.u) && same_bits(pair.v, expected->distance.v) &&
           pair.feature == expected->distance.feature && found.distance.feature == expected->distance.feature;
}

struct Tally {
    std::uint64_t found = 0, touching = 0, nothing = 0;

    void count(const ClosestPoint& pair) {
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
    detail::DistantSegment distant;
    const ClosestPoint pair = closest_point(blob.opened.blob, segment, capsule.radius);
    const QueryStatus status = detail::round_segment(detail::data_of(blob.opened.blob), segment, distant.segment);
    REQUIRE((is_refused(pair.status) ? pair.status : QueryStatus::ok) == status);
    if (status == QueryStatus::ok) {
        REQUIRE(equals_loop(blob, loop, distant, capsule.radius, pair));
        REQUIRE(overlaps(blob.opened.blob, capsule).yes() == (pair.triangle != no_triangle));
        tally.count(pair);
    }

    Box box = maker.box(awkward);
    box.min = sum(box.min, off);
    box.max = sum(box.max, off);
    CAPTURE(describe(box));
    const float max_distance = maker.random().below(3) == 0 ? 0.0f : capsule.radius;
    detail::DistantBox distant_box;
    const ClosestPoint to_box = closest_point(blob.opened.blob, box, max_distance);
    const QueryStatus box_status =
        detail::round_segment(detail::data_of(blob.opened.blob), {box.min, box.max}, distant_box.segment);
    REQUIRE((is_refused(to_box.status) ? to_box.status : QueryStatus::ok) == box_status);
    if (box_status != QueryStatus::ok) return;
    const auto is_above = [](float a, float b) { return detail::flush_subnormal(a) > detail::flush_subnormal(b); };
    if (is_above(box.min.x, box.max.x) || is_above(box.min.y, box.max.y) || is_above(box.min.z, box.max.z)) {
        REQUIRE(to_box.status == QueryStatus::not_found);
        return;
    }
    REQUIRE(equals_loop(blob, loop, distant_box, max_distance, to_box));
    if (max_distance == 0.0f && distant_box.segment.fraction_bits == 6)
        REQUIRE(overlaps(blob.opened.blob, box).yes() == (to_box.triangle != no_triangle));
    tally.count(to_box);
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

TEST_CASE("closest point: segments and boxes equal the loop and agree with overlaps") {
    check(small_test_blobs(), scaled_share(100));
    check(medium_test_blobs(), scaled_share(12));
}

TEST_CASE("closest point: segments and boxes equal the loop on real meshes") {
    for_each_real_mesh([](const Mesh& mesh, Profile profile) {
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

TEST_CASE("closest point: a cube and a segment match hand-computed values") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    // Above a face, across a side, past a corner, through the cube, and one end inside.
    ClosestPoint pair = closest_point(cube.blob, Segment{{0.25f, 0.5f, 3.0f}, {0.25f, 0.5f, 9.0f}});
    CHECK(pair.on_shape == Vec3{0.25f, 0.5f, 3.0f});
    CHECK(pair.point == Vec3{0.25f, 0.5f, 1.0f});
    CHECK(pair.distance == 2.0f);
    CHECK(pair.face_normal == Vec3{0.0f, 0.0f, 1.0f});
    CHECK(pair.feature == Feature::face);
    CHECK(pair.side == Side::front);
    pair = closest_point(cube.blob, Segment{{4.0f, 0.0f, 5.0f}, {4.0f, 10.0f, 5.0f}});
    CHECK(pair.distance == 5.0f);
    CHECK(pair.point.x == 1.0f);
    CHECK(pair.point.z == 1.0f);
    CHECK(pair.on_shape.y == pair.point.y);
    CHECK(pair.feature != Feature::face);
    pair = closest_point(cube.blob, Segment{{4.0f, 4.0f, 1.0f}, {4.0f, 4.0f, 30.0f}});
    CHECK(pair.point == Vec3{1.0f, 1.0f, 1.0f});
    CHECK(pair.on_shape == Vec3{4.0f, 4.0f, 1.0f});
    CHECK(pair.feature >= Feature::vertex_a);
    pair = closest_point(cube.blob, Segment{{0.25f, 0.5f, -3.0f}, {0.25f, 0.5f, 3.0f}});
    CHECK(pair.distance == 0.0f);
    CHECK(pair.on_shape == pair.point);
    CHECK(pair.feature == Feature::face);
    CHECK(pair.side == Side::front);  // a part of it is
    pair = closest_point(cube.blob, Segment{{0.25f, 0.25f, -3.0f}, {0.25f, 0.25f, 3.0f}});
    CHECK(pair.distance == 0.0f);
    CHECK(pair.feature != Feature::face);  // through a diagonal
    pair = closest_point(cube.blob, Segment{{0.0f, 0.0f, 0.0f}, {0.5f, 0.0f, 0.0f}});
    CHECK(pair.distance == 0.5f);
    CHECK(pair.side == Side::back);
    pair = closest_point(cube.blob, Segment{{4.0f, 5.0f, 13.0f}, {4.0f, 5.0f, 13.0f}});
    CHECK(pair.distance == 13.0f);
}

TEST_CASE("closest point: braces mean a point") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    const ClosestPoint nearest = closest_point(cube.blob, {0.25f, 0.5f, 3.0f});
    CHECK(nearest.on_shape == Vec3{0.25f, 0.5f, 3.0f});
    CHECK(nearest.distance == 2.0f);
}

TEST_CASE("closest point: a cube and a box match hand-computed values") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    ClosestPoint pair = closest_point(cube.blob, Box{{4.0f, 5.0f, 13.0f}, {5.0f, 6.0f, 14.0f}});
    CHECK(pair.on_shape == Vec3{4.0f, 5.0f, 13.0f});
    CHECK(pair.point == Vec3{1.0f, 1.0f, 1.0f});
    CHECK(pair.distance == 13.0f);
    CHECK(pair.feature >= Feature::vertex_a);
    // Around all of the cube, touching it, and within it: a box is solid, a surface is not.
    pair = closest_point(cube.blob, Box{{-9.0f, -9.0f, -9.0f}, {9.0f, 9.0f, 9.0f}}, 0.0f);
    CHECK(pair.distance == 0.0f);
    CHECK(pair.triangle.index == 0);
    CHECK(pair.side == Side::front);
    pair = closest_point(cube.blob, Box{{1.0f, 0.0f, 0.0f}, {2.0f, 0.5f, 0.5f}}, 0.0f);
    CHECK(pair.distance == 0.0f);
    CHECK(pair.on_shape == pair.point);
    pair = closest_point(cube.blob, Box{{-0.25f, -0.5f, -0.5f}, {0.75f, 0.5f, 0.5f}});
    CHECK(pair.distance == 0.25f);
    CHECK(pair.point.x == 1.0f);
    CHECK(pair.face_normal == Vec3{1.0f, 0.0f, 0.0f});
    CHECK(pair.side == Side::back);
}

TEST_CASE("closest point: the two points are as far apart as the distance within some ulp") {
    for (const TestBlob& blob : small_test_blobs()) {
        CAPTURE(blob.name);
        ShapeMaker maker(blob.decoded, 1600);
        const Blob& opened = blob.opened.blob;
        for (std::uint64_t i = 0; i < scaled_share(100); ++i) {
            const Capsule capsule = maker.capsule(i % 2 == 0);
            const Box box = maker.box(i % 2 == 0);
            const auto check_pair = [&](const ClosestPoint& pair, Vec3 from, Vec3 to) {
                double most = 0.0;
                for (const Vec3& v : {from, to, opened.bounds().min, opened.bounds().max})
                    most = std::max(most, static_cast<double>(largest(v)));
                // The shape is rounded to the lattice's grid too.
                const double slack = most * 28.0 * 0x1p-23 + std::ldexp(1.0, opened.lattice().step_exponent - 5);
                REQUIRE(std::fabs(length(difference(pair.on_shape, pair.point)) - static_cast<double>(pair.distance)) <=
                        slack);
                const double low = std::min(static_cast<double>(from.x), static_cast<double>(to.x)) - slack;
                const double high = std::max(static_cast<double>(from.x), static_cast<double>(to.x)) + slack;
                REQUIRE(static_cast<double>(pair.on_shape.x) >= low);
                REQUIRE(static_cast<double>(pair.on_shape.x) <= high);
            };
            CAPTURE(describe(capsule));
            if (const ClosestPoint pair = closest_point(opened, Segment{capsule.from, capsule.to}))
                check_pair(pair, capsule.from, capsule.to);
            CAPTURE(describe(box));
            if (const ClosestPoint pair = closest_point(opened, box)) check_pair(pair, box.min, box.max);
        }
    }
}

TEST_CASE("closest point: feature and side of segments and boxes are exact") {
    std::uint64_t behind = 0, asked = 0, features[7] = {};
    for (const TestBlob& blob : small_test_blobs()) {
        CAPTURE(blob.name);
        ShapeMaker maker(blob.decoded, 1620);
        const Blob& opened = blob.opened.blob;
        for (std::uint64_t i = 0; i < scaled_share(60); ++i) {
            const Capsule capsule = maker.capsule(i % 2 == 0);
            const Box box = maker.box(i % 2 == 0);
            const Segment segment = {capsule.from, capsule.to};
            const auto check_one_shape = [&](const ClosestPoint& pair, const Segment& rounded_from, bool is_box) {
                if (!pair) return;
                detail::RoundedSegment rounded;
                REQUIRE(detail::round_segment(detail::data_of(opened), rounded_from, rounded) == QueryStatus::ok);
                const oracle::Triangle t = exact_triangle(blob.decoded.triangles.at(pair.triangle.index));
                const oracle::Point normal = oracle::normal_of(t);
                bool all_behind = true;
                for (unsigned corner = 0; corner < 8; ++corner) {
                    oracle::Point at;
                    for (unsigned k = 0; k < 3; ++k) {
                        const bool is_to = is_box ? (corner >> k & 1u) != 0 : (corner & 1u) != 0;
                        at[k] = oracle::Rational::of(is_to ? rounded.to[k] : rounded.from[k], -rounded.fraction_bits);
                    }
                    const oracle::Point from_plane = at - t.a;
                    all_behind = all_behind && normal.dot(from_plane).sign() < 0;
                }
                REQUIRE(pair.side == (all_behind ? Side::back : Side::front));
                behind += all_behind ? 1u : 0u;
                ++asked;
                ++features[static_cast<unsigned>(pair.feature)];
                // Weights are rounded: those of a corner or side are zero, those of the rest may be.
                const float w = 1.0f - pair.u - pair.v;
                const float weights[3] = {std::fabs(w) < 0x1p-20f ? 0.0f : w, pair.u, pair.v};
                const Feature edges[3] = {Feature::edge_bc, Feature::edge_ca, Feature::edge_ab};
                const Feature corners[3] = {Feature::vertex_a, Feature::vertex_b, Feature::vertex_c};
                for (unsigned k = 0; k < 3; ++k) {
                    if (pair.feature == edges[k]) REQUIRE(weights[k] == 0.0f);
                    if (pair.feature != corners[k]) continue;
                    REQUIRE(weights[(k + 1) % 3] == 0.0f);
                    REQUIRE(weights[(k + 2) % 3] == 0.0f);
                }
            };
            CAPTURE(describe(capsule));
            check_one_shape(closest_point(opened, segment), segment, false);
            CAPTURE(describe(box));
            check_one_shape(closest_point(opened, box), {box.min, box.max}, true);
        }
    }
    if (!asks_enough()) return;
    CHECK(behind > asked / 20);
    CHECK(behind < asked);
    for (const std::uint64_t each : features) CHECK(each > 0);
}

TEST_CASE("closest point: shapes that are refused are no misses") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    const Vec3 near{2.0f, 0.0f, 0.0f};
    const Vec3 far{1e30f, 0.0f, 0.0f};
    const auto check_status = [](const ClosestPoint& pair, QueryStatus status) {
        CHECK_FALSE(pair);
        ClosestPoint expected;
        expected.status = status;
        CHECK(same_bits(pair, expected));
    };
    check_status(closest_point(cube.blob, Segment{near, {not_a_number, 0.0f, 0.0f}}, 1.0f),
                 QueryStatus::invalid_argument);
    check_status(closest_point(cube.blob, Segment{near, {0.0f, infinity, 0.0f}}), QueryStatus::invalid_argument);
    check_status(closest_point(cube.blob, Segment{near, near}, not_a_number), QueryStatus::invalid_argument);
    check_status(closest_point(cube.blob, Segment{near, near}, -1.0f), QueryStatus::invalid_argument);
    check_status(closest_point(cube.blob, Segment{near, far}), QueryStatus::out_of_range);
    check_status(closest_point(cube.blob, Box{near, {not_a_number, 0.0f, 0.0f}}, 1.0f), QueryStatus::invalid_argument);
    check_status(closest_point(cube.blob, Box{near, near}, -infinity), QueryStatus::invalid_argument);
    check_status(closest_point(cube.blob, Box{near, far}), QueryStatus::out_of_range);
    check_status(closest_point(Blob(), Segment{near, near}), QueryStatus::not_open);
    check_status(closest_point(Blob(), Box{near, {not_a_number, 0.0f, 0.0f}}), QueryStatus::not_open);
    check_status(closest_point(cube.blob, Segment{near, near}, 0.5f), QueryStatus::not_found);
    check_status(closest_point(cube.blob, Box{{1.0f, 1.0f, 1.0f}, {0.0f, 1.0f, 1.0f}}), QueryStatus::not_found);
    const OpenedBlob empty(Mesh{});
    check_status(closest_point(empty.blob, Segment{near, near}), QueryStatus::not_found);
    check_status(closest_point(empty.blob, Box{near, near}), QueryStatus::not_found);
    check_status(closest_point(empty.blob, Segment{near, near}, not_a_number), QueryStatus::invalid_argument);
}

}  // namespace
}  // namespace espalier::tests::closest_pair_test
