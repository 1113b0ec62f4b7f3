// Claims about where two triangles touch: their common points by exact crossings and by clipping, the way out by the
// reference in double.
#include "support/testing.hpp"

#include <runtime/contacts/touch.hpp>
#include <runtime/kernels/triangle_triangle.hpp>

#include "support/exact/as_rationals.hpp"
#include "support/exact/grid_triangles.hpp"

#include "touched.hpp"

namespace espalier::tests::touch_pair_test {
namespace {

using detail::contacts::TrianglesTouch;

/// A triangle that often touches another one: at a corner, along a side, in its plane, or across it; also without area.
GridTriangle triangle_near(Random& random, unsigned bits, const GridTriangle& t) {
    GridTriangle other = some_triangle(random, bits);
    switch (random.below(6)) {
        case 0:
            break;
        case 1:
            other.a = random.coin() ? t.a : t.b;
            break;
        case 2:
            other.a = t.b;
            other.b = t.a;
            break;
        case 3:  // in the plane, with corners on t's or beyond
            for (GridPoint* p : {&other.a, &other.b, &other.c}) {
                const std::int32_t u = random.between(-1, 2), v = random.between(-1, 2);
                for (unsigned k = 0; k < 3; ++k) (*p)[k] = t.a[k] + u * (t.b[k] - t.a[k]) + v * (t.c[k] - t.a[k]);
            }
            break;
        case 4:
            for (GridPoint* p : {&other.a, &other.b, &other.c}) *p = point_near(random, bits, t);
            break;
        default:  // through a place on the side
            for (unsigned k = 0; k < 3; ++k) other.b[k] = t.a[k] + t.b[k] - other.a[k];
    }
    if (random.below(16) == 0) other.c = random.coin() ? other.a : other.b;
    if (random.below(64) == 0) other.b = other.c = other.a;
    return other;
}

bool has_area(const GridTriangle& t) { return oracle::normal_of(exact_triangle(t)) != oracle::Point(0, 0, 0); }

Point rounded(const oracle::Point& p) { return {p[0].rounded(), p[1].rounded(), p[2].rounded()}; }

/// Where sides of one triangle cross the other's plane within it.
void add_crossings(const GridTriangle& p, const GridTriangle& q, Points& points) {
    const oracle::Triangle sides = exact_triangle(p), face = exact_triangle(q);
    const oracle::Point* const corner[3] = {&sides.a, &sides.b, &sides.c};
    for (unsigned i = 0; i < 3; ++i) {
        const oracle::Line line = {*corner[i], *corner[(i + 1) % 3] - *corner[i]};
        if (line.direction == oracle::Point(0, 0, 0)) continue;
        const auto crossing = oracle::cross(line, face);
        if (!crossing || crossing->t < oracle::Rational(0) || oracle::Rational(1) < crossing->t) continue;
        points.push_back(rounded(line.origin + crossing->t * line.direction));
    }
}

/// Cuts a polygon in the plane of a triangle by its sides (Sutherland and Hodgman 1974).
Points clipped(Points polygon, const Points& triangle) {
    const Point normal = reference::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    for (unsigned i = 0; i < 3; ++i) {
        const Point inward = reference::cross(normal, triangle[(i + 1) % 3] - triangle[i]);
        Points kept;
        for (std::size_t j = 0; j < polygon.size(); ++j) {
            const Point &here = polygon[j], &next = polygon[(j + 1) % polygon.size()];
            const double at = reference::dot(here - triangle[i], inward),
                         then = reference::dot(next - triangle[i], inward);
            if (at >= 0.0) kept.push_back(here);
            if ((at > 0.0 && then < 0.0) || (at < 0.0 && then > 0.0))
                kept.push_back(here + (at / (at - then)) * (next - here));
        }
        polygon = kept;
    }
    return polygon;
}

TEST_CASE("pair: two triangles have the points and the way out of the reference") {
    Random random(21);
    const std::uint64_t count = scaled(10'000);
    std::uint64_t touching = 0, polygons = 0, segments = 0;
    double worst_point = 0.0, worst_depth = 0.0;
    for (std::uint64_t i = 0; i < count; ++i) {
        const unsigned bits = 2 + random.below(21);
        const GridTriangle a = some_triangle(random, bits), b = triangle_near(random, bits, a);
        TrianglesTouch touch;
        detail::contacts::touch_triangles(lattice_triangle(a), lattice_triangle(b), touch);
        CAPTURE(i);
        REQUIRE((touch.count > 0) == detail::triangles_meet(lattice_triangle(a), lattice_triangle(b)));
        if (touch.count == 0) continue;
        ++touching;
        const Points of_a = corners_of(a), of_b = corners_of(b);
        double size = 1.0, side = 1.0;
        for (const Points* corners : {&of_a, &of_b}) {
            for (unsigned k = 0; k < 3; ++k) {
                size = std::max(size, reference::length((*corners)[k] - of_a[0]));
                side = std::max(side, reference::length((*corners)[k] - (*corners)[(k + 1) % 3]));
            }
        }
        // The points: in both triangles, and around all that the reference has.
        Points found;
        for (unsigned k = 0; k < touch.count; ++k) found.push_back(to_point(touch.point[k]));
        // The kernel counts from the lattice's origin, where a float holds 24 bits.
        const double error = side * 0x1p-21 + std::ldexp(1.0, static_cast<int>(bits)) * 0x1p-23;
        for (const Point& p : found) {
            const double off = std::sqrt(std::max(reference::squared_distance(p, {of_a[0], of_a[1], of_a[2]}),
                                                  reference::squared_distance(p, {of_b[0], of_b[1], of_b[2]})));
            worst_point = std::max(worst_point, off / error);
            REQUIRE(off <= error);
        }
        for (std::size_t k = 0; k < found.size(); ++k)
            for (std::size_t other = 0; other < k; ++other)
                if (bits < 9) REQUIRE(reference::length(found[k] - found[other]) > 1e-3);  // each once
        Points expected;
        const bool lie_in_one_plane = [&] {
            const oracle::Triangle t = exact_triangle(a), o = exact_triangle(b);
            const oracle::Point normal = oracle::normal_of(t);
            for (const oracle::Point* p : {&o.a, &o.b, &o.c})
                if (normal.dot(*p - t.a) != oracle::Rational(0)) return false;
            return true;
        }();
        if (lie_in_one_plane) {
            ++polygons;
            if (bits < 14) expected = clipped(of_b, of_a);
            REQUIRE(touch.depth <= size * 0x1p-20);
        } else {
            ++segments;
            add_crossings(b, a, expected);
            if (has_area(b)) add_crossings(a, b, expected);
            REQUIRE(touch.count <= 2);
        }
        for (const Point& p : expected) REQUIRE(reference::signed_separation({p}, found) <= error);
        // The way out.
        const double depth = static_cast<double>(touch.depth), slack = size * 0x1p-20;
        const double least = -reference::signed_separation(of_a, of_b);
        worst_depth = std::max(worst_depth, std::abs(depth - least) / size);
        REQUIRE(std::abs(depth - least) <= slack);
        const Point normal = to_point(touch.normal);
        REQUIRE(std::abs(reference::length(normal) - 1.0) < 1e-6);
        REQUIRE(reference::gap_along(normal, of_b, of_a) >= -depth - slack);
    }
    CHECK(touching > count / 4);
    CHECK(polygons > count / 20);
    CHECK(segments > count / 8);
    MESSAGE(count, " pairs, ", touching, " touch, ", polygons, " in one plane; worst error of points ", worst_point,
            " of the bound, of depths ", worst_depth, " of the size");
}

}  // namespace
}  // namespace espalier::tests::touch_pair_test
