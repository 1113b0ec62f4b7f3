// Claims about shapes that touch a triangle where they start: how deep they are in it, and which ways lead out, against
// the overlaps along all separating directions in rational numbers.
#include "support/testing.hpp"

#include <Eigen/Geometry>

#include <runtime/sweeps/queries.hpp>

#include "oracle/exact_geometry.hpp"
#include "oracle/rational.hpp"

namespace espalier::tests::start_test {
namespace {

using detail::BoxSweep;
using detail::HullSweep;
using detail::Integer3;
using detail::LatticeTriangle;
using oracle::Point;
using oracle::Rational;

Point exact(const Integer3& a) { return Point(Rational(a.x), Rational(a.y), Rational(a.z)); }
std::array<Point, 3> exact(const LatticeTriangle& triangle, int bits) {
    std::array<Point, 3> result;
    for (unsigned i = 0; i < 3; ++i) {
        const auto& c = triangle.corner[i];
        result[i] = exact(Integer3{c[0], c[1], c[2]}) * Rational::of(1, bits);
    }
    return result;
}

/// A shape by its points, and the directions in which it may leave the triangle.
struct Body {
    std::vector<Point> points;
    std::vector<Point> directions;
    std::array<Point, 3> triangle;
    Point way;
};

/// A way out: the squared length, and how far the displacement leads along it.
struct Out {
    Rational squared;
    Rational along;
};

std::vector<Out> ways_out(const Body& body, const Rational& time = 0) {
    std::vector<Out> result;
    const auto add = [&](const Point& w) {
        if (w.dot(w).sign() == 0) return;
        Rational low = w.dot(body.points[0]), high = w.dot(body.triangle[0]);
        for (const Point& p : body.points) low = std::min(low, w.dot(p));
        for (const Point& q : body.triangle) high = std::max(high, w.dot(q));
        const Rational overlap = high - low - time * w.dot(body.way);
        // Apart is nothing to leave.
        const Rational squared = overlap.sign() <= 0 ? Rational(0) : overlap * overlap / w.dot(w);
        result.push_back({squared, w.dot(body.way)});
    };
    for (const Point& w : body.directions) {
        add(w);
        add(-w);
    }
    return result;
}
Rational least(const std::vector<Out>& ways) {
    Rational result = ways.front().squared;
    for (const Out& out : ways) result = std::min(result, out.squared);
    return result;
}

/// How many cases stay, leave, and have no way out.
using Seen = std::array<std::uint64_t, 3>;

template <class Sweep>
void require_right(const Sweep& sweep, const LatticeTriangle& triangle, const Body& body, bool has_all_directions,
                   Seen& seen) {
    const std::vector<Out> ways = ways_out(body);
    if (ways.empty()) {  // on one line or at one point, without a way out
        REQUIRE(detail::gap_at_start(sweep, triangle) == 0.0f);
        REQUIRE_FALSE(detail::leaves_at_start(sweep, triangle));
        ++seen[2];
        return;
    }
    const Rational depth = least(ways), more = Rational(1) + Rational::of(1, -19);
    const float gap = detail::gap_at_start(sweep, triangle);
    REQUIRE(gap <= 0.0f);
    const Rational found = Rational::of(gap) * Rational::of(gap);
    REQUIRE(found <= depth * more);
    REQUIRE(depth <= found * more);
    const bool leaves = detail::leaves_at_start(sweep, triangle);
    REQUIRE(std::any_of(ways.begin(), ways.end(), [&](const Out& out) {
        return out.squared <= depth * more && (out.along.sign() >= 0) == leaves;
    }));
    ++seen[leaves ? 1 : 0];
    if (!leaves || !has_all_directions) return;
    for (const int halvings : {0, 1, 4, 12}) REQUIRE(least(ways_out(body, Rational::of(1, -halvings))) <= depth * more);
}

struct Maker {
    Random& random;
    std::int32_t size = 1 << random.between(2, 16);
    int bits = random.between(0, 6);

    Integer3 some(std::int64_t scale) {
        const auto one = [&] { return std::int64_t{random.between(-size, size)} * scale; };
        return {one(), one(), one()};
    }
    LatticeTriangle triangle() {
        LatticeTriangle result{};
        for (auto& corner : result.corner)
            for (std::int32_t& at : corner) at = random.between(0, size);
        if (random.below(4) == 0)
            for (auto& corner : result.corner) corner[2] = result.corner[0][2];
        // Deformable blobs have triangles without area.
        if (random.below(8) == 0)
            for (std::int32_t(&corner)[3] : result.corner)
                for (int k = 0; k < 3; ++k)
                    if (k != 0 || random.coin()) corner[k] = result.corner[0][k];
        return result;
    }
    [[nodiscard]] Integer3 corner_of(const LatticeTriangle& triangle) const {
        const auto& at = triangle.corner[0];
        return Integer3{at[0], at[1], at[2]} * (std::int64_t{1} << bits);
    }
    Integer3 way() {
        Integer3 result = some(std::int64_t{1} << bits);
        if (random.below(3) == 0) result.z = 0;
        return result;
    }
};

void add_sides(Body& body, std::vector<Point>& sides) {
    for (unsigned i = 0; i < 3; ++i) sides.push_back(body.triangle[(i + 1) % 3] - body.triangle[i]);
}
Point normal_of(const Body& body) { return oracle::normal_of({body.triangle[0], body.triangle[1], body.triangle[2]}); }

void set_box(Body& body, const Point& corner, const std::array<Point, 3>& edges) {
    for (unsigned i = 0; i < 8; ++i) {
        Point at = corner;
        for (unsigned j = 0; j < 3; ++j)
            if ((i >> j & 1u) != 0) at = at + edges[j];
        body.points.push_back(at);
    }
    std::vector<Point> sides;
    add_sides(body, sides);
    body.directions.push_back(normal_of(body));
    for (unsigned i = 0; i < 3; ++i) {
        body.directions.push_back(edges[(i + 1) % 3].cross(edges[(i + 2) % 3]));
        for (const Point& side : sides) body.directions.push_back(edges[i].cross(side));
    }
}

/// Compares many starts in overlap. make(maker, triangle, sweep, body) sets shape and body.
template <class Sweep, class Make>
void require_right_starts(std::uint64_t seed, std::uint64_t count, bool has_all_directions, const Make& make) {
    Random random(seed);
    Seen seen{};
    for (std::uint64_t i = 0; i < scaled(count); ++i) {
        CAPTURE(i);
        Maker maker{random};
        const LatticeTriangle triangle = maker.triangle();
        Sweep sweep{};
        sweep.fraction_bits = maker.bits;
        Body body{{}, {}, exact(triangle, maker.bits), {}};
        make(maker, triangle, sweep, body);
        if (detail::first_contact_tick(sweep, triangle, 0) != 0) continue;
        body.way = exact(sweep.displacement);
        require_right(sweep, triangle, body, has_all_directions, seen);
    }
    if (!asks_enough()) return;
    CHECK(seen[0] > 50);
    CHECK(seen[1] > 50);
    // Hulls always have the coordinate axes.
    if (has_all_directions) CHECK(seen[2] > 5);
}

TEST_CASE("sweep: a box leaves a triangle at the start along its shortest way out") {
    require_right_starts<BoxSweep>(
        90, 3'000, true, [](Maker& maker, const LatticeTriangle& t, BoxSweep& sweep, Body& body) {
            const std::int64_t unit = std::int64_t{1} << maker.bits;
            Integer3 a = maker.some(unit), b = maker.some(unit);
            if (maker.random.below(8) == 0) a = b = maker.corner_of(t);
            if (maker.random.below(16) == 0) b.y = a.y = maker.corner_of(t).y;
            sweep.low = smaller(a, b);
            sweep.high = larger(a, b);
            sweep.displacement = maker.way();
            const Integer3 edge = sweep.high - sweep.low;
            set_box(body, exact(sweep.low),
                    {exact(Integer3{edge.x, 0, 0}), exact(Integer3{0, edge.y, 0}), exact(Integer3{0, 0, edge.z})});
        });
}

TEST_CASE("sweep: an oriented box leaves a triangle at the start along its shortest way out") {
    require_right_starts<HullSweep>(
        91, 2'000, true, [](Maker& maker, const LatticeTriangle& t, HullSweep& sweep, Body& body) {
            sweep.is_box = true;
            sweep.moving.point_count = 8;
            const std::int64_t unit = std::int64_t{1} << maker.bits;
            Integer3 first = maker.some(unit), edges[3] = {maker.some(unit), maker.some(unit), maker.some(unit)};
            if (maker.random.below(8) == 0) {
                first = maker.corner_of(t);
                for (Integer3& edge : edges) edge = {maker.random.coin() ? edge.x : 0, 0, 0};
            }
            for (unsigned corner = 0; corner < 8; ++corner) {
                Integer3 at = first;
                for (unsigned j = 0; j < 3; ++j)
                    if ((corner >> j & 1u) != 0) at = at + edges[j];
                for (int k = 0; k < 3; ++k) sweep.moving.point[corner][k] = static_cast<std::int32_t>(at[k]);
            }
            sweep.displacement = sweep.moving.displacement = maker.way();
            set_box(body, exact(first), {exact(edges[0]), exact(edges[1]), exact(edges[2])});
        });
}

TEST_CASE("sweep: a hull leaves a triangle at the start along the shortest of the directions that it tries") {
    require_right_starts<HullSweep>(
        92, 2'000, false, [](Maker& maker, const LatticeTriangle&, HullSweep& sweep, Body& body) {
            sweep.is_box = false;
            sweep.moving.point_count = 1 + maker.random.below(10);
            for (unsigned p = 0; p < sweep.moving.point_count; ++p) {
                const Integer3 at = maker.some(std::int64_t{1} << maker.bits);
                for (int k = 0; k < 3; ++k) sweep.moving.point[p][k] = static_cast<std::int32_t>(at[k]);
                body.points.push_back(exact(at));
            }
            sweep.displacement = sweep.moving.displacement = maker.way();
            std::vector<Point> sides;
            add_sides(body, sides);
            const Point normal = normal_of(body);
            body.directions.push_back(normal);
            for (const Point& side : sides) body.directions.push_back(normal.cross(side));
            for (const Integer3& unit : {Integer3{1, 0, 0}, Integer3{0, 1, 0}, Integer3{0, 0, 1}})
                body.directions.push_back(exact(unit));
        });
}

}  // namespace
}  // namespace espalier::tests::start_test
