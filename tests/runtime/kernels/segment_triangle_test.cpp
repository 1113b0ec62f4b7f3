// Claims about the kernel of segments: exact decisions and distances within 6 ulp, against the oracle, which solves a
// linear system for each pair of faces.
#include "support/testing.hpp"

#include <runtime/kernels/segment_triangle.hpp>

#include "support/exact/grid_triangles.hpp"

namespace espalier::tests::segment_triangle_test {
namespace {

using detail::RoundedSegment;
using detail::SegmentDistance;
using oracle::Point;

struct Case {
    GridTriangle triangle;
    RoundedSegment segment;
};

/// A segment around a triangle, at all sizes: ends on corners, sides and faces, parallel to sides, in the plane,
/// through it, of length zero, and far away.
Case some_case(Random& random) {
    Case result;
    const unsigned bits = 1 + random.below(24);
    const GridTriangle& triangle = result.triangle = any_triangle(random, bits);
    const GridPoint corners[3] = {triangle.a, triangle.b, triangle.c};
    const auto weighted = [&](const float* weights) {
        float at[3];
        for (unsigned k = 0; k < 3; ++k) {
            at[k] = 0.0f;
            for (int i = 0; i < 3; ++i) at[k] += weights[i] * static_cast<float>(corners[i][k]);
        }
        return Vec3{at[0], at[1], at[2]};
    };
    /// On the triangle's plane, most often on the triangle, at a corner or the middle of a side as often as elsewhere.
    const auto on_plane = [&] {
        float weights[3] = {0.0f, 0.0f, 0.0f};
        const auto kind = random.below(4);
        if (kind == 0) weights[random.below(3)] = 1.0f;
        else if (kind == 1) {
            weights[random.below(3)] += 0.5f;
            weights[random.below(3)] += 0.5f;
        } else if (kind == 2) {
            weights[0] = static_cast<float>(random.between(-8, 12)) / 4.0f;
            weights[1] = static_cast<float>(random.between(-8, 12)) / 4.0f;
            weights[2] = 1.0f - weights[0] - weights[1];
        } else {
            weights[0] = random.unit();
            weights[1] = (1.0f - weights[0]) * random.unit();
            weights[2] = 1.0f - weights[0] - weights[1];
        }
        return weighted(weights);
    };
    const auto off = [&] {
        return random.in_cube(std::ldexp(1.0f, random.between(-6, static_cast<std::int32_t>(bits) + 12)));
    };
    Segment segment;
    segment.from = on_plane();
    switch (random.below(6)) {
        case 0:  // in the plane
            segment.to = on_plane();
            break;
        case 1:  // of length zero
            segment.from = sum(segment.from, off());
            segment.to = segment.from;
            break;
        case 2: {  // through a point of the triangle
            const Vec3 by = off();
            segment.to = difference(segment.from, by);
            segment.from = sum(segment.from, by);
            break;
        }
        case 3: {  // parallel to the plane, often to a side
            const Vec3 by = off();
            segment.to = sum(on_plane(), by);
            segment.from = sum(segment.from, by);
            break;
        }
        case 4:  // from somewhere onto the triangle
            segment.to = sum(segment.from, off());
            std::swap(segment.from, segment.to);
            break;
        default:  // anywhere
            segment.from = sum(segment.from, off());
            segment.to = sum(on_plane(), off());
    }
    if (detail::round_segment(tests::lattice_asset(bits), segment, result.segment) != QueryStatus::ok)
        return some_case(random);
    return result;
}

std::array<Point, 2> exact_segment(const RoundedSegment& segment) {
    std::array<Point, 2> ends;
    for (int k = 0; k < 3; ++k) {
        ends[0][k] = Rational::of(segment.from[k], -segment.fraction_bits);
        ends[1][k] = Rational::of(segment.to[k], -segment.fraction_bits);
    }
    return ends;
}

Rational exact_square(const Case& c) {
    const std::array<Point, 3> triangle = {tests::exact_point(c.triangle.a), tests::exact_point(c.triangle.b),
                                           tests::exact_point(c.triangle.c)};
    return oracle::squared_distance(exact_segment(c.segment), triangle);
}

TEST_CASE("kernel: the squared distance of segment and triangle is within 6 ulp and 0 exactly at contact") {
    std::uint64_t decided = 0;
    Random random(1);
    Rational worst = 0;
    std::uint64_t touching = 0, inner = 0;
    const std::uint64_t count = scaled(4'000);
    for (std::uint64_t i = 0; i < count; ++i) {
        const Case c = some_case(random);
        const Rational expected = exact_square(c);
        const SegmentDistance distance = detail::distance_to(c.segment, tests::lattice_triangle(c.triangle));
        CAPTURE(i);
        ++decided;
        REQUIRE((distance.squared == 0.0f) == (expected.sign() == 0));
        worst = std::max(worst, oracle::error_in_ulp(distance.squared, expected));
        REQUIRE(worst <= Rational(6));
        if (expected.sign() == 0) ++touching;
        if (distance.along > 0.0f && distance.along < 1.0f) ++inner;

        // The pair of points that was named is no farther apart, to the precision of the sizes.
        REQUIRE(distance.along >= 0.0f);
        REQUIRE(distance.along <= 1.0f);
        REQUIRE(distance.u >= 0.0f);
        REQUIRE(distance.v >= 0.0f);
        const auto ends = exact_segment(c.segment);
        const oracle::Triangle triangle = tests::exact_triangle(c.triangle);
        const Point on_segment = ends[0] + (ends[1] - ends[0]) * Rational::of(distance.along);
        Rational size = size_of(triangle);
        for (int k = 0; k < 3; ++k) size += oracle::absolute(ends[1][k] - ends[0][k]);
        const Point between = on_segment - weighted(triangle, distance.u, distance.v);
        const Rational squared = between.dot(between);
        const Rational allowed = expected * (Rational(1) + Rational::of(6, -23));
        REQUIRE(is_root_within(squared, allowed, size * Rational::of(1, -21)));
    }
    CHECK(touching > count / 20);
    CHECK(inner > count / 10);
    MESSAGE(decisions_made("segment and triangle that touch", decided));
}

TEST_CASE("kernel: a segment within a radius of a triangle is decided exactly") {
    check_within_radius("segment and triangle within a radius", scaled(2'000), [](Random& random, auto check) {
        const Case c = some_case(random);
        const auto triangle = tests::lattice_triangle(c.triangle);
        const SegmentDistance distance = detail::distance_to(c.segment, triangle);
        check(distance.squared, exact_square(c),
              [&](float radius) { return detail::is_within_radius(c.segment, triangle, distance, radius); });
    });
}

TEST_CASE("kernel: segments out of range and NaN and infinity are refused") {
    const detail::BlobData asset = tests::lattice_asset(16);
    RoundedSegment segment;
    const Vec3 near{1.0f, 2.0f, 3.0f};
    CHECK(detail::round_segment(asset, {near, {0.0f, not_a_number, 0.0f}}, segment) == QueryStatus::invalid_argument);
    CHECK(detail::round_segment(asset, {{0.0f, 0.0f, infinity}, near}, segment) == QueryStatus::invalid_argument);
    CHECK(detail::round_segment(asset, {{0x1p36f, 0.0f, 0.0f}, near}, segment) == QueryStatus::out_of_range);
    CHECK(detail::round_segment(asset, {near, {0.0f, 0.0f, -0x1p36f}}, segment) == QueryStatus::out_of_range);
    CHECK(detail::round_segment(asset, {near, {0x1.fep35f, 0.0f, -0x1.fep35f}}, segment) == QueryStatus::ok);
    CHECK(segment.fraction_bits == 0);
    CHECK(detail::round_segment(asset, {near, {0x1p24f, 0.0f, 0.015625f}}, segment) == QueryStatus::ok);
    CHECK(segment.fraction_bits == 6);
    CHECK(segment.to[2] == 1);
}

}  // namespace
}  // namespace espalier::tests::segment_triangle_test
