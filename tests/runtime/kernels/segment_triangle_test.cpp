// Claims about the kernel of segments: exact decisions and distances within 6 ulp, against the oracle, which solves a
// linear system for each pair of faces.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <runtime/kernels/segment_triangle.hpp>

#include "support/base/calls.hpp"
#include "support/base/random.hpp"
#include "support/base/test_scale.hpp"
#include "support/exact/as_rationals.hpp"

namespace espalier::tests::segment_triangle_test {
namespace {

using detail::RoundedSegment;
using detail::SegmentDistance;
using oracle::Point;
using oracle::Rational;

struct Case {
    GridTriangle triangle;
    RoundedSegment segment;
};

/// A segment around a triangle, at all sizes: ends on corners, sides and faces, parallel to sides, in the plane,
/// through it, of length zero, and far away.
Case some_case(Random& random) {
    Case result;
    const unsigned bits = 1 + random.below(24);
    const std::int32_t limit = (1 << bits) - 1;
    const auto some_point = [&] {
        const std::int32_t x = random.between(0, limit);
        const std::int32_t y = random.between(0, limit);
        const std::int32_t z = random.below(3) == 0 ? 0 : random.between(0, limit);
        return GridPoint{x, y, z};
    };
    GridTriangle& triangle = result.triangle;
    triangle = {some_point(), some_point(), some_point()};
    switch (random.below(6)) {
        case 0:  // a sliver
            for (unsigned k = 0; k < 3; ++k)
                triangle.c[k] = std::clamp((triangle.a[k] + triangle.b[k]) / 2 + random.between(-1, 1), 0, limit);
            break;
        case 1:  // no area
            triangle.c = random.coin() ? triangle.a : triangle.b;
            if (random.below(3) == 0) triangle.b = triangle.a;
            break;
        default:
            break;
    }
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
        switch (random.below(4)) {
            case 0:
                weights[random.below(3)] = 1.0f;
                break;
            case 1:
                weights[random.below(3)] += 0.5f;
                weights[random.below(3)] += 0.5f;
                break;
            case 2:
                weights[0] = static_cast<float>(random.between(-8, 12)) / 4.0f;
                weights[1] = static_cast<float>(random.between(-8, 12)) / 4.0f;
                weights[2] = 1.0f - weights[0] - weights[1];
                break;
            default:
                weights[0] = random.unit();
                weights[1] = (1.0f - weights[0]) * random.unit();
                weights[2] = 1.0f - weights[0] - weights[1];
        }
        return weighted(weights);
    };
    const auto plus = [](Vec3 a, Vec3 b) { return Vec3{a.x + b.x, a.y + b.y, a.z + b.z}; };
    const auto minus = [](Vec3 a, Vec3 b) { return Vec3{a.x - b.x, a.y - b.y, a.z - b.z}; };
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
            segment.from = plus(segment.from, off());
            segment.to = segment.from;
            break;
        case 2: {  // through a point of the triangle
            const Vec3 by = off();
            segment.to = minus(segment.from, by);
            segment.from = plus(segment.from, by);
            break;
        }
        case 3: {  // parallel to the plane, often to a side
            const Vec3 by = off();
            segment.to = plus(on_plane(), by);
            segment.from = plus(segment.from, by);
            break;
        }
        case 4:  // from somewhere onto the triangle
            segment.to = plus(segment.from, off());
            std::swap(segment.from, segment.to);
            break;
        default:  // anywhere
            segment.from = plus(segment.from, off());
            segment.to = plus(on_plane(), off());
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
    std::uint64_t touching = 0;
    std::uint64_t inner = 0;
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
        const Point on_triangle = triangle.a + (triangle.b - triangle.a) * Rational::of(distance.u) +
                                  (triangle.c - triangle.a) * Rational::of(distance.v);
        Rational size = 0;
        for (int k = 0; k < 3; ++k) {
            size += oracle::absolute(triangle.b[k] - triangle.a[k]) + oracle::absolute(triangle.c[k] - triangle.a[k]) +
                    oracle::absolute(ends[1][k] - ends[0][k]);
        }
        const Point between = on_segment - on_triangle;
        const Rational squared = between.dot(between);
        // sqrt(squared) <= sqrt(allowed) + slack, squared twice.
        const Rational allowed = expected * (Rational(1) + Rational::of(6, -23));
        const Rational slack = size * Rational::of(1, -21);
        const Rational above = squared - allowed - slack * slack;
        REQUIRE((above.sign() <= 0 || above * above <= Rational(4) * slack * slack * allowed));
    }
    CHECK(touching > count / 20);
    CHECK(inner > count / 10);
    MESSAGE(decisions_made("segment and triangle that touch", decided));
}

TEST_CASE("kernel: a segment within a radius of a triangle is decided exactly") {
    std::uint64_t decided = 0;
    Random random(2);
    std::uint64_t exactly = 0;
    const std::uint64_t count = scaled(2'000);
    for (std::uint64_t i = 0; i < count; ++i) {
        const Case c = some_case(random);
        const auto triangle = tests::lattice_triangle(c.triangle);
        const SegmentDistance distance = detail::distance_to(c.segment, triangle);
        const Rational squared = exact_square(c);
        float radius = std::sqrt(distance.squared);
        for (int step = 0; step < 4 && radius > 0.0f; ++step) radius = std::nextafter(radius, 0.0f);
        for (int step = 0; step < 9; ++step, radius = std::nextafter(radius, 1e30f)) {
            if (radius > 0.0f && radius < 0x1p-100f) radius = 0x1p-100f;
            const Rational square = Rational::of(radius) * Rational::of(radius);
            CAPTURE(i);
            CAPTURE(radius);
            ++decided;
            REQUIRE(detail::is_within_radius(c.segment, triangle, distance, radius) == (squared <= square));
            if (squared == square) ++exactly;
        }
        REQUIRE(detail::is_within_radius(c.segment, triangle, distance, 1e30f));
        REQUIRE(detail::is_within_radius(c.segment, triangle, distance, std::numeric_limits<float>::infinity()));
    }
    CHECK(exactly > count / 100);
    MESSAGE(decisions_made("segment and triangle within a radius", decided));
}

TEST_CASE("kernel: segments out of range and NaN and infinity are refused") {
    const detail::BlobData asset = tests::lattice_asset(16);
    RoundedSegment segment;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Vec3 near{1.0f, 2.0f, 3.0f};
    CHECK(detail::round_segment(asset, {near, {0.0f, nan, 0.0f}}, segment) == QueryStatus::invalid_argument);
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
