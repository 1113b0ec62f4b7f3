// Claims about the oracle's geometry, on cases whose answers are known without it.
#include <doctest/doctest.h>

#include "exact_geometry.hpp"
#include "support/base/random.hpp"
#include "support/base/test_scale.hpp"

namespace espalier::tests::exact_geometry_test {
namespace {

using espalier::oracle::Point;
using espalier::oracle::Rational;

Point point(int x, int y, int z) { return Point(Rational(x), Rational(y), Rational(z)); }

const oracle::Triangle corner_triangle{point(0, 0, 0), point(4, 0, 0), point(0, 4, 0)};

TEST_CASE("oracle: a ray onto a known triangle crosses it at the hand-computed point") {
    const auto inside = oracle::cross({point(1, 2, 8), point(0, 0, -2)}, corner_triangle);
    REQUIRE(inside.has_value());
    CHECK(inside->t == Rational(4));
    CHECK(inside->u == Rational(1, 4));
    CHECK(inside->v == Rational(1, 2));
    CHECK(inside->front);
    const auto behind = oracle::cross({point(1, 1, 8), point(0, 0, 1)}, corner_triangle);
    REQUIRE(behind.has_value());
    CHECK(behind->t == Rational(-8));
    CHECK_FALSE(behind->front);
}

TEST_CASE("oracle: touching an edge or a corner counts and one step beside it does not") {
    CHECK(oracle::cross({point(0, 0, 1), point(0, 0, -1)}, corner_triangle));
    CHECK(oracle::cross({point(2, 2, 1), point(0, 0, -1)}, corner_triangle));
    CHECK(oracle::cross({point(4, 0, 1), point(0, 0, -1)}, corner_triangle));
    CHECK_FALSE(oracle::cross({point(5, 0, 1), point(0, 0, -1)}, corner_triangle));
    CHECK_FALSE(oracle::cross({point(2, 3, 1), point(0, 0, -1)}, corner_triangle));
    CHECK_FALSE(oracle::cross({point(-1, 1, 1), point(0, 0, -1)}, corner_triangle));
    Point just_outside = point(2, 2, 1);
    just_outside.x() += Rational::of(1, -200);
    CHECK_FALSE(oracle::cross({just_outside, point(0, 0, -1)}, corner_triangle));
}

TEST_CASE("oracle: a ray in the plane of the triangle crosses nothing") {
    CHECK_FALSE(oracle::cross({point(-1, 1, 0), point(1, 0, 0)}, corner_triangle));
}

TEST_CASE("oracle: closest points inside and on a side and at a corner match known values") {
    const auto above = oracle::closest_on_triangle(corner_triangle, point(1, 1, 7));
    CHECK(above.point == point(1, 1, 0));
    CHECK(above.squared_distance == Rational(49));
    const auto beside = oracle::closest_on_triangle(corner_triangle, point(3, 3, 0));
    CHECK(beside.point == point(2, 2, 0));
    CHECK(beside.squared_distance == Rational(2));
    const auto beyond = oracle::closest_on_triangle(corner_triangle, point(-3, -4, 12));
    CHECK(beyond.point == point(0, 0, 0));
    CHECK(beyond.squared_distance == Rational(169));
}

TEST_CASE("oracle: no point of a triangle is closer than the closest one") {
    Random random(1);
    const auto some = [&] { return point(random.between(-50, 50), random.between(-50, 50), random.between(-50, 50)); };
    for (std::uint64_t i = 0; i < scaled(300); ++i) {
        const oracle::Triangle triangle{some(), some(), some()};
        if (oracle::normal_of(triangle) == point(0, 0, 0)) continue;
        const Point from = some();
        const auto closest = oracle::closest_on_triangle(triangle, from);
        for (int j = 0; j < 20; ++j) {
            Rational u(random.between(0, 16), 16);
            Rational v(random.between(0, 16), 16);
            if (u + v > Rational(1)) {
                u = Rational(1) - u;
                v = Rational(1) - v;
            }
            const Point other = triangle.a + (triangle.b - triangle.a) * u + (triangle.c - triangle.a) * v;
            REQUIRE((from - other).dot(from - other) >= closest.squared_distance);
        }
    }
}

}  // namespace
}  // namespace espalier::tests::exact_geometry_test
