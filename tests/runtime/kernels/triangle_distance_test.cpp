// Claims about the distance of two triangles, against the oracle: ends against faces, and sides against sides.
#include "support/testing.hpp"

#include <runtime/kernels/triangle_distance.hpp>

#include "oracle/convex_hull.hpp"
#include "support/exact/as_rationals.hpp"

namespace espalier::tests::triangle_distance_test {
namespace {

using detail::LatticeTriangle;

oracle::Point corner_of(const LatticeTriangle& t, int corner) {
    const auto& c = t.corner[corner];
    return oracle::Point(Rational(std::int64_t{c[0]}), Rational(std::int64_t{c[1]}), Rational(std::int64_t{c[2]}));
}

oracle::Triangle exact(const LatticeTriangle& t) { return {corner_of(t, 0), corner_of(t, 1), corner_of(t, 2)}; }

/// Between the insides of two segments, if they have a common perpendicular there.
std::optional<Rational> between_insides(const oracle::Point& p, const oracle::Point& d, const oracle::Point& q,
                                        const oracle::Point& e) {
    const Rational dd = d.dot(d), ee = e.dot(e), de = d.dot(e);
    const Rational whole = dd * ee - de * de;
    if (whole.sign() == 0) return std::nullopt;
    const oracle::Point w = q - p;
    const Rational s = (w.dot(d) * ee - w.dot(e) * de) / whole;
    const Rational t = (w.dot(d) * de - w.dot(e) * dd) / whole;
    const Rational one = 1;
    if (s.sign() < 0 || s > one || t.sign() < 0 || t > one) return std::nullopt;
    const oracle::Point apart = w + e * t - d * s;
    return apart.dot(apart);
}

bool share_a_point(const LatticeTriangle& a, const LatticeTriangle& b) {
    const auto points = [](const LatticeTriangle& t) {
        std::vector<oracle::WholePoint<oracle::BigInteger>> result;
        for (const auto& c : t.corner)
            result.push_back({oracle::BigInteger(c[0]), oracle::BigInteger(c[1]), oracle::BigInteger(c[2])});
        return result;
    };
    return oracle::hulls_meet(points(a), points(b));
}

Rational squared_distance(const LatticeTriangle& a, const LatticeTriangle& b) {
    if (share_a_point(a, b)) return 0;
    const oracle::Triangle exact_a = exact(a), exact_b = exact(b);
    Rational best = oracle::closest_on_triangle(exact_a, exact_b.a).squared_distance;
    for (int i = 0; i < 3; ++i) {
        best = std::min(best, oracle::closest_on_triangle(exact_a, corner_of(b, i)).squared_distance);
        best = std::min(best, oracle::closest_on_triangle(exact_b, corner_of(a, i)).squared_distance);
        for (int j = 0; j < 3; ++j) {
            const oracle::Point p = corner_of(a, i), q = corner_of(b, j);
            const auto inner = between_insides(p, corner_of(a, (i + 1) % 3) - p, q, corner_of(b, (j + 1) % 3) - q);
            if (inner) best = std::min(best, *inner);
        }
    }
    return best;
}

LatticeTriangle lattice_triangle(Random& random, unsigned bits) {
    LatticeTriangle t;
    const std::int32_t limit = (1 << bits) - 1;
    for (auto& corner : t.corner)
        for (std::int32_t& x : corner) x = random.below(4) == 0 ? 0 : random.between(-limit, limit);
    return t;
}

bool has_area(const LatticeTriangle& t) {
    return !(oracle::normal_of(exact(t)) == oracle::Point(Rational(0), Rational(0), Rational(0)));
}

/// Takes the area from a triangle: it becomes a segment or a point.
void flatten(LatticeTriangle& t, Random& random) {
    const unsigned from = random.below(3);
    for (int k = 0; k < 3; ++k) {
        if (random.below(4) != 0) t.corner[(from + 1) % 3][k] = t.corner[from][k];
        else t.corner[(from + 1) % 3][k] = (t.corner[from][k] + t.corner[(from + 2) % 3][k]) / 2;
    }
    if (has_area(t)) std::copy_n(t.corner[from], 3, t.corner[(from + 1) % 3]);
    if (random.below(4) == 0) std::copy_n(t.corner[from], 3, t.corner[(from + 2) % 3]);
    if (has_area(t)) std::copy_n(t.corner[from], 3, t.corner[(from + 1) % 3]);
}

/// Of any triangles: all pairs of corners, sides and faces.
Rational squared_distance_of_hulls(const LatticeTriangle& a, const LatticeTriangle& b) {
    const std::array<oracle::Point, 3> of_a = {corner_of(a, 0), corner_of(a, 1), corner_of(a, 2)};
    const std::array<oracle::Point, 3> of_b = {corner_of(b, 0), corner_of(b, 1), corner_of(b, 2)};
    return oracle::squared_distance(of_a, of_b);
}

TEST_CASE("kernel: the squared distance of triangles is within 6 ulp and its witnesses are as far") {
    std::uint64_t decided = 0;
    Random random(31);
    Rational worst = 0;
    std::uint64_t touching = 0, checked = 0, flat = 0;
    const std::uint64_t count = scaled(1'500);
    for (std::uint64_t i = 0; i < count; ++i) {
        const unsigned bits = 1 + random.below(24);
        LatticeTriangle a = lattice_triangle(random, bits), b = lattice_triangle(random, bits);
        if (random.coin())  // beside each other
            for (auto& corner : b.corner) corner[random.below(3)] += random.coin() ? 0 : 1 << (bits < 23 ? bits : 22);
        if (random.below(4) == 0) flatten(a, random);
        if (random.below(4) == 0) flatten(b, random);
        const bool is_flat = !has_area(a) || !has_area(b);
        (is_flat ? flat : checked) += 1;
        const Rational expected = is_flat ? squared_distance_of_hulls(a, b) : squared_distance(a, b);
        const detail::TriangleDistance distance = detail::distance_between(a, b);
        ++decided;
        REQUIRE((distance.squared == 0.0f) == (expected.sign() == 0));
        if (expected.sign() == 0) ++touching;
        else worst = std::max(worst, oracle::error_in_ulp(distance.squared, expected));
        const auto at = [](const LatticeTriangle& t, const detail::Weights& weights) -> oracle::Point {
            const oracle::Triangle e = exact(t);
            return e.a + (e.b - e.a) * Rational::of(weights.u) + (e.c - e.a) * Rational::of(weights.v);
        };
        const oracle::Point apart = at(a, distance.on_a) - at(b, distance.on_b);
        // Weights are floats: each witness is off by some 2^-22 of its triangle's size.
        const Rational off = Rational::of(std::int64_t{1} << bits, -18);
        for (int k = 0; k < 3; ++k)
            if (expected.sign() == 0) REQUIRE(oracle::absolute(apart[k]) <= off);
        if (expected.sign() != 0) {
            const float root = std::sqrt(distance.squared);
            const Rational reach = Rational::of(root) + off + off;
            REQUIRE(apart.dot(apart) <= reach * reach);
        }
        float radius = std::sqrt(distance.squared);
        for (int step = 0; step < 2; ++step) radius = std::nextafter(radius, 0.0f);
        for (int step = 0; step < 5; ++step, radius = std::nextafter(radius, 1e30f)) {
            const Rational exact_radius = Rational::of(radius);
            if (radius > 0.0f && radius < 0x1p-100f) continue;
            REQUIRE(detail::is_within_radius(a, b, distance, radius) == (expected <= exact_radius * exact_radius));
        }
    }
    CHECK(worst <= Rational(6));
    CHECK(flat > checked / 4);
    CHECK(touching > checked / 20);
    CHECK(touching < checked);
    MESSAGE(decisions_made("two triangles that touch, by distance", decided));
}

}  // namespace
}  // namespace espalier::tests::triangle_distance_test
