// Claims about the distance of boxes and triangles: exact decisions and distances within 6 ulp, against the oracle,
// which cuts the box into tetrahedra.
#include "support/testing.hpp"

#include <runtime/kernels/triangle_distance.hpp>

#include "support/exact/grid_triangles.hpp"

namespace espalier::tests::box_distance_test {
namespace {

using detail::RoundedSegment;
using detail::SegmentDistance;
using oracle::Point;

struct Case {
    GridTriangle triangle;
    RoundedSegment box;
};

/// Boxes and triangles around one another, at all sizes: flat boxes, coordinates in common, one in the other, slivers.
Case some_case(Random& random) {
    Case result;
    const unsigned bits = 1 + random.below(random.coin() ? 4 : 24);
    const GridTriangle& triangle = result.triangle = any_triangle(random, bits);
    const GridPoint corners[3] = {triangle.a, triangle.b, triangle.c};
    float low[3], high[3];
    const float reach =
        std::ldexp(1.0f, random.between(-6, static_cast<std::int32_t>(bits) + (random.below(4) == 0 ? 12 : 0)));
    for (unsigned k = 0; k < 3; ++k) {
        const auto some_coordinate = [&] {
            const auto at = static_cast<float>(corners[random.below(3)][k]);
            const auto kind = random.below(4);
            if (kind == 0) return at;
            if (kind == 1) return 0.5f * (at + static_cast<float>(corners[random.below(3)][k]));
            return at + reach * random.signed_unit();
        };
        low[k] = some_coordinate();
        high[k] = random.below(6) == 0 ? low[k] : some_coordinate();
        if (low[k] > high[k]) std::swap(low[k], high[k]);
    }
    const Segment diagonal = {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
    if (detail::round_segment(tests::lattice_asset(bits), diagonal, result.box) != QueryStatus::ok)
        return some_case(random);
    return result;
}

/// Kuhn's six tetrahedra: from the lowest corner to the highest one along each order of the axes.
Rational exact_square(const Case& c) {
    const std::array<Point, 3> triangle = {tests::exact_point(c.triangle.a), tests::exact_point(c.triangle.b),
                                           tests::exact_point(c.triangle.c)};
    const auto coordinate = [&](int k, bool high) {
        return Rational::of(high ? c.box.to[k] : c.box.from[k], -c.box.fraction_bits);
    };
    std::array<int, 3> axes = {0, 1, 2};
    Rational least = -1;
    do {
        std::array<Point, 4> corners;
        std::array<bool, 3> high = {false, false, false};
        for (std::size_t i = 0; i < 4; ++i) {
            for (int k = 0; k < 3; ++k) corners[i][k] = coordinate(k, high[static_cast<std::size_t>(k)]);
            if (i < 3) high[static_cast<std::size_t>(axes[i])] = true;
        }
        const Rational squared = oracle::squared_distance(corners, triangle);
        if (least.sign() < 0 || squared < least) least = squared;
    } while (std::next_permutation(axes.begin(), axes.end()) && least.sign() != 0);
    return least;
}

TEST_CASE("kernel: the squared distance of box and triangle is within 6 ulp and 0 exactly at contact") {
    std::uint64_t decided = 0;
    Random random(1);
    Rational worst = 0;
    std::uint64_t touching = 0;
    const std::uint64_t count = scaled(400);
    for (std::uint64_t i = 0; i < count; ++i) {
        const Case c = some_case(random);
        const Rational expected = exact_square(c);
        const SegmentDistance distance = detail::distance_to_box(c.box, tests::lattice_triangle(c.triangle));
        CAPTURE(i);
        ++decided;
        REQUIRE((distance.squared == 0.0f) == (expected.sign() == 0));
        worst = std::max(worst, oracle::error_in_ulp(distance.squared, expected));
        REQUIRE(worst <= Rational(6));
        if (expected.sign() == 0) ++touching;

        // The point on the triangle that was named is no farther from the box, to the precision of the sizes.
        REQUIRE(distance.u >= 0.0f);
        REQUIRE(distance.v >= 0.0f);
        const oracle::Triangle triangle = tests::exact_triangle(c.triangle);
        const Point at = weighted(triangle, distance.u, distance.v);
        Rational size = size_of(triangle), squared = 0;
        for (int k = 0; k < 3; ++k) {
            const Rational low = Rational::of(c.box.from[k], -c.box.fraction_bits);
            const Rational high = Rational::of(c.box.to[k], -c.box.fraction_bits);
            size += high - low;
            const Rational gap = at[k] < low ? low - at[k] : at[k] > high ? at[k] - high : Rational(0);
            squared += gap * gap;
        }
        const Rational allowed = expected * (Rational(1) + Rational::of(6, -23));
        REQUIRE(is_root_within(squared, allowed, size * Rational::of(1, -21)));
    }
    CHECK(touching > count / 10);
    CHECK(touching < count * 9 / 10);
    MESSAGE(decisions_made("box and triangle that touch, by distance", decided));
}

TEST_CASE("kernel: a box within a radius of a triangle is decided exactly") {
    check_within_radius("box and triangle within a radius", scaled(150), [](Random& random, auto check) {
        const Case c = some_case(random);
        const auto triangle = tests::lattice_triangle(c.triangle);
        const SegmentDistance distance = detail::distance_to_box(c.box, triangle);
        check(distance.squared, exact_square(c),
              [&](float radius) { return detail::is_within_radius_of_box(c.box, triangle, distance, radius); });
    });
}

}  // namespace
}  // namespace espalier::tests::box_distance_test
