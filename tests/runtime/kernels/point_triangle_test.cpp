// Claims about the distance kernel: exact squared distances and exact decisions, against the oracle's projections.
#include "support/testing.hpp"

#include <runtime/kernels/point_triangle.hpp>

#include "support/exact/as_rationals.hpp"
#include "support/exact/grid_triangles.hpp"

namespace espalier::tests::point_triangle_test {
namespace {

using detail::PointDistance;
using detail::RoundedPoint;
using oracle::BigInteger;

Rational exact(detail::Int128 value) { return {BigInteger::of_words(value.high, value.low), 1}; }

Rational exact_square(const PointDistance& distance, int fraction_bits) {
    Rational numerator = exact(distance.numerator);
    if (distance.square_numerator) numerator *= numerator;
    return numerator / exact(distance.denominator) * Rational::of(1, -2 * fraction_bits);
}

/// Which part of the triangle a point of it lies on.
Feature exact_feature(const oracle::Triangle& t, const oracle::Point& p) {
    if (p == t.a) return Feature::vertex_a;
    if (p == t.b) return Feature::vertex_b;
    if (p == t.c) return Feature::vertex_c;
    const auto is_on = [&](const oracle::Point& from, const oracle::Point& to) {
        return oracle::normal_of({from, to, p}) == oracle::Point(0, 0, 0);
    };
    return is_on(t.a, t.b)   ? Feature::edge_ab
           : is_on(t.b, t.c) ? Feature::edge_bc
           : is_on(t.c, t.a) ? Feature::edge_ca
                             : Feature::face;
}

struct Case {
    GridTriangle triangle;
    RoundedPoint point;
};

/// At all sizes; nothing if a triangle without area was drawn.
std::optional<GridTriangle> triangle_with_area(Random& random, unsigned bits) {
    const std::int32_t limit = (1 << bits) - 1;
    const GridPoint a = some_low_point(random, limit), b = some_low_point(random, limit);
    GridTriangle triangle = {a, b, some_low_point(random, limit)};
    if (random.below(3) == 0) make_sliver(random, limit, triangle);
    if (oracle::normal_of(tests::exact_triangle(triangle)) == oracle::Point(0, 0, 0)) return std::nullopt;
    return triangle;
}

/// Draws a point on or around a triangle; false if it is too far away.
bool some_point(Random& random, unsigned bits, const GridTriangle& triangle, RoundedPoint& result) {
    const GridPoint corners[3] = {triangle.a, triangle.b, triangle.c};
    const GridPoint p = corners[random.below(3)];
    const GridPoint q = corners[random.below(3)];
    const auto coordinate = [&](unsigned k, float share, float off) {
        return static_cast<float>(p[k]) + share * static_cast<float>(q[k] - p[k]) + off;
    };
    const float share = random.coin() ? 0.5f : random.unit();
    const float reach =
        random.below(4) == 0 ? 0.0f : std::ldexp(1.0f, random.between(-6, static_cast<std::int32_t>(bits) + 12));
    const Vec3 off = random.in_cube(reach);
    const Vec3 world{coordinate(0, share, off.x), coordinate(1, share, off.y), coordinate(2, share, off.z)};
    return detail::round_point(tests::lattice_asset(bits), world, 0.0f, result) == QueryStatus::ok;
}

/// Triangles and points on and around one another; false if the triangle has no area.
bool some_case(Random& random, Case& result) {
    const unsigned bits = 1 + random.below(24);
    const auto triangle = triangle_with_area(random, bits);
    if (!triangle) return false;
    result.triangle = *triangle;
    return some_point(random, bits, *triangle, result.point);
}

TEST_CASE("kernel: the squared distance of point and triangle is exact as a quotient and within 6 ulp") {
    Random random(1);
    Rational worst = 0;
    std::uint64_t zero = 0, face = 0, checked = 0;
    std::array<std::uint64_t, 7> features{};
    const std::uint64_t count = scaled(20'000);
    for (std::uint64_t i = 0; i < count; ++i) {
        Case c;
        if (!some_case(random, c)) continue;
        const oracle::Triangle triangle = tests::exact_triangle(c.triangle);
        const auto closest = oracle::closest_on_triangle(triangle, tests::exact_center(c.point));
        const PointDistance distance = detail::distance_to(c.point, tests::lattice_triangle(c.triangle));
        REQUIRE(exact_square(distance, c.point.fraction_bits) == closest.squared_distance);
        worst = std::max(worst, oracle::error_in_ulp(distance.squared, closest.squared_distance));
        REQUIRE(distance.feature == exact_feature(triangle, closest.point));
        ++features.at(static_cast<std::size_t>(distance.feature));
        // The weights lead to the closest point, to the precision of the triangle's size.
        const oracle::Point at = weighted(triangle, distance.u, distance.v);
        for (int k = 0; k < 3; ++k) {
            const Rational size =
                oracle::absolute(triangle.b[k] - triangle.a[k]) + oracle::absolute(triangle.c[k] - triangle.a[k]);
            REQUIRE(oracle::absolute(at[k] - closest.point[k]) <= size * Rational::of(1, -22));
        }
        if (closest.squared_distance.sign() == 0) ++zero;
        if (distance.square_numerator) ++face;
        ++checked;
    }
    CHECK(worst <= Rational(6));
    CHECK(checked > count / 2);
    CHECK(zero > count / 100);
    CHECK(face > count / 50);
    for (const std::uint64_t met : features) CHECK(met > count / 100);
}

TEST_CASE("kernel: the distance of a point from a triangle without area is that from its segment or point") {
    Random random(3);
    Rational worst = 0;
    std::uint64_t zero = 0, checked = 0;
    const std::uint64_t count = scaled(8'000);
    for (std::uint64_t i = 0; i < count; ++i) {
        CAPTURE(i);
        const unsigned bits = 1 + random.below(24);
        Case c;
        c.triangle = tests::flat_triangle(random, bits);
        if (!some_point(random, bits, c.triangle, c.point)) continue;
        const oracle::Triangle t = tests::exact_triangle(c.triangle);
        const std::array<oracle::Point, 1> center = {tests::exact_center(c.point)};
        const auto from = [&](std::vector<oracle::Point> hull) { return oracle::squared_distance(center, hull); };
        const Rational expected = from({t.a, t.b, t.c});
        const PointDistance distance = detail::distance_to(c.point, tests::lattice_triangle(c.triangle));
        REQUIRE(exact_square(distance, c.point.fraction_bits) == expected);
        worst = std::max(worst, oracle::error_in_ulp(distance.squared, expected));
        // The feature that is named has the closest point.
        const std::vector<oracle::Point> features[] = {{t.a, t.b, t.c}, {t.a, t.b}, {t.b, t.c}, {t.c, t.a},
                                                       {t.a},           {t.b},      {t.c}};
        static_assert(Feature::edge_ab == Feature{1} && Feature::vertex_c == Feature{6});
        const auto named = static_cast<std::size_t>(distance.feature);
        REQUIRE(named != 0);
        REQUIRE(from(features[named]) == expected);
        // The weights lead there.
        REQUIRE(distance.u >= 0.0f);
        REQUIRE(distance.v >= 0.0f);
        const Rational reached = from({weighted(t, distance.u, distance.v)});
        REQUIRE(is_root_within(reached, expected, size_of(t) * Rational::of(1, -22)));
        if (expected.sign() == 0) ++zero;
        ++checked;
    }
    CHECK(worst <= Rational(6));
    CHECK(checked > count / 2);
    CHECK(zero > count / 100);
}

TEST_CASE("kernel: a triangle within a radius of a point is decided exactly") {
    check_within_radius("point and triangle within a radius", scaled(10'000), [](Random& random, auto check) {
        Case c;
        const unsigned flat_bits = 1 + random.below(24);
        const bool is_flat = random.below(4) == 0;
        if (is_flat) c.triangle = tests::flat_triangle(random, flat_bits);
        if (!(is_flat ? some_point(random, flat_bits, c.triangle, c.point) : some_case(random, c))) return;
        const PointDistance distance = detail::distance_to(c.point, tests::lattice_triangle(c.triangle));
        check(distance.squared, exact_square(distance, c.point.fraction_bits),
              [&](float radius) { return detail::is_within_radius(c.point, distance, radius); });
    });
}

}  // namespace
}  // namespace espalier::tests::point_triangle_test
