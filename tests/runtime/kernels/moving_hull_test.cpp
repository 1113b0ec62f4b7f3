// The kernel of convex hulls that move: the tick of the first contact, exactly, and the contact itself, against the
// oracle, which tries all triangles of differences.
#include "support/testing.hpp"

#include <Eigen/Geometry>

#include <runtime/kernels/moving_shapes.hpp>
#include <runtime/kernels/point_triangle.hpp>

#include "moving_scene.hpp"
#include "oracle/convex_hull.hpp"
#include "oracle/exact_geometry.hpp"
#include "oracle/rational.hpp"

namespace espalier::tests::moving_hull_test {
namespace {

using namespace espalier::tests::moving;
using detail::MovingHull;
using oracle::BigInteger;

Integer3 point_of(const MovingHull& hull, unsigned i) { return {hull.point[i][0], hull.point[i][1], hull.point[i][2]}; }
void add(MovingHull& hull, const Integer3& point) {
    for (int k = 0; k < 3; ++k) hull.point[hull.point_count][k] = static_cast<std::int32_t>(point[k]);
    ++hull.point_count;
}
void add_box(MovingHull& hull, const Integer3& center, const std::array<Integer3, 3>& half) {
    for (unsigned i = 0; i < 8; ++i) {
        Integer3 corner = center;
        for (unsigned k = 0; k < 3; ++k) corner = (i >> k & 1u) != 0 ? plus(corner, half[k]) : minus(corner, half[k]);
        add(hull, corner);
    }
}

/// Points around one, of a hull of every kind: also a flat one, a segment, a point, and the triangle's own shape.
void add_points(Scene& scene, const Integer3& from, MovingHull& hull) {
    Random& random = scene.random;
    const unsigned bits = random.below(3) == 0 ? random.below(scene.bits + 1) : scene.bits;
    const auto some = [&] { return scene.some_point(bits); };
    const auto& corner = scene.triangle.corner;
    const Integer3 side = minus(corner[1], corner[0]), other_side = minus(corner[2], corner[0]);
    switch (random.below(8)) {
        case 0:
            add_box(hull, from, {some(), some(), some()});
            break;
        case 1: {
            const Integer3 size = some();
            add_box(hull, from, {Integer3{size.x, 0, 0}, Integer3{0, size.y, 0}, Integer3{0, 0, size.z}});
            break;
        }
        case 2:  // parallel to the triangle
            add_box(hull, from,
                    {side, random.coin() ? other_side : some(), random.coin() ? Integer3{0, 0, 0} : some()});
            break;
        case 3:
            add(hull, from);
            if (random.coin()) add(hull, plus(from, random.coin() ? side : some()));
            break;
        case 4:  // the triangle itself
            for (const Integer3& c : corner) add(hull, plus(from, minus(c, corner[0])));
            break;
        case 5: {  // along an axis and flat
            const int k = static_cast<int>(random.below(3));
            for (unsigned i = 0; i < 5; ++i) {
                Integer3 off = some();
                off[k] = 0;
                add(hull, plus(from, off));
            }
            break;
        }
        default: {
            const unsigned count = 1 + random.below(9);
            add(hull, from);
            for (unsigned i = 1; i < count; ++i) add(hull, plus(from, some()));
            if (random.below(4) == 0) add(hull, point_of(hull, 0));
            break;
        }
    }
}

Case<MovingHull> some_hull(Random& random) {
    for (;;) {
        Scene scene(random);
        MovingHull hull{};
        hull.displacement = scene.some_way();
        const std::int64_t radius = std::min(scene.some_radius(), std::int64_t{1} << 24);
        const Integer3 start = scene.some_start(scene.some_target(), hull.displacement, radius);
        constexpr std::int64_t most = std::int64_t{1} << 29;
        if (!is_below(start, most) || !is_below(hull.displacement, most)) continue;
        add_points(scene, start, hull);
        return {hull, scene.triangle};
    }
}

std::string describe(const Case<MovingHull>& c) {
    std::string text;
    const auto tell = [&](const Integer3& a) {
        for (const auto axis : axes) text += " " + std::to_string(a.*axis);
        text += ";";
    };
    for (const Integer3& corner : c.triangle.corner) tell(corner);
    text += " way";
    tell(c.moving.displacement);
    text += " points";
    for (unsigned i = 0; i < c.moving.point_count; ++i) tell(point_of(c.moving, i));
    return text;
}

template <class Number>
oracle::WholePoint<Number> whole(const Integer3& a) {
    return {Number(a.x), Number(a.y), Number(a.z)};
}
Rational rational(const BigInteger& numerator, const BigInteger& denominator) { return {numerator, denominator}; }
__extension__ using Int = __int128;
BigInteger big(Int a) {
    return BigInteger::of_words(static_cast<std::int64_t>(a >> 64), static_cast<std::uint64_t>(a));
}
Rational rational(Int numerator, Int denominator) { return {big(numerator), big(denominator)}; }

/// The line of the displacement meets the hull of the differences first at one end of the contact, last at the other.
template <class Number>
std::optional<Rational> first_contact_in(const Case<MovingHull>& c) {
    std::vector<oracle::WholePoint<Number>> points, opposite;
    for (const Integer3& corner : c.triangle.corner)
        for (unsigned i = 0; i < c.moving.point_count; ++i)
            points.push_back(whole<Number>(minus(corner, point_of(c.moving, i))));
    const Integer3 way = c.moving.displacement;
    if (way.x == 0 && way.y == 0 && way.z == 0)
        return oracle::hull_has_origin(points) ? std::optional<Rational>(0) : std::nullopt;
    const auto first = oracle::line_enters_hull(points, whole<Number>(way));
    if (!first) return std::nullopt;
    const Rational enters = rational(first->numerator, first->denominator);
    if (enters > Rational(1)) return std::nullopt;
    if (enters.sign() >= 0) return enters;
    const auto last = oracle::line_enters_hull(points, whole<Number>(minus({0, 0, 0}, way)));
    if (rational(last->numerator, last->denominator).sign() > 0) return std::nullopt;
    return Rational(0);
}
std::optional<Rational> exact_first_contact(const Case<MovingHull>& c) {
    std::int64_t largest = 0;
    const auto look_at = [&](const Integer3& a) {
        for (const auto axis : axes) largest = std::max({largest, a.*axis, -(a.*axis)});
    };
    for (const Integer3& corner : c.triangle.corner) look_at(corner);
    for (unsigned i = 0; i < c.moving.point_count; ++i) look_at(point_of(c.moving, i));
    look_at(c.moving.displacement);
    // Numbers of the oracle are products of eleven coordinates at most, but for a few bits.
    return largest < 256 ? first_contact_in<Int>(c) : first_contact_in<BigInteger>(c);
}

TEST_CASE("kernel: a moving hull touches first at the tick of the oracle") {
    std::uint64_t decided = 0;
    Random random(6);
    std::array<std::uint64_t, 3> seen{};
    std::uint64_t landings = 0;
    const std::uint64_t count = scaled(1'500);
    for (std::uint64_t i = 0; i < count; ++i) {
        const Case<MovingHull> c = some_hull(random);
        const SweepTick tick = first_contact_tick(c.moving, c.triangle, whole_way);
        const std::optional<Rational> time = exact_first_contact(c);
        CAPTURE(i);
        CAPTURE(describe(c));
        ++decided;
        require_right_limits(c, tick, random, seen);
        if (!require_tick(time, tick)) continue;

        // The normal separates, and looks against the way.
        const SweepContact contact = contact_at(c.moving, c.triangle, tick);
        const Point way = exact(c.moving.displacement), normal = require_normal(contact, way);
        const Point moved = way * *time;
        std::optional<Rational> of_hull, of_triangle;
        Rational size = 0;
        const auto look_at = [&](const Point& at) {
            for (int k = 0; k < 3; ++k) size = std::max(size, oracle::absolute(at[k] - exact(c.triangle.corner[0])[k]));
            return Rational(normal.dot(at));
        };
        for (unsigned p = 0; p < c.moving.point_count; ++p) {
            const Rational at = look_at(exact(point_of(c.moving, p)) + moved);
            of_hull = of_hull ? std::min(*of_hull, at) : at;
        }
        for (const Integer3& corner : c.triangle.corner) {
            const Rational at = look_at(exact(corner));
            of_triangle = of_triangle ? std::max(*of_triangle, at) : at;
        }
        REQUIRE(*of_hull >= *of_triangle - size * Rational::of(1, -20));

        // Where the hull lands on the triangle's own plane, the normal is that plane's.
        const Point corner = exact(c.triangle.corner[0]);
        Point face = (exact(c.triangle.corner[1]) - corner).cross(exact(c.triangle.corner[2]) - corner);
        if (face.dot(way).sign() > 0) face = face * Rational(-1);
        if (face.dot(way).sign() != 0) {
            std::optional<Rational> gap;
            for (unsigned p = 0; p < c.moving.point_count; ++p) {
                const Rational at = face.dot(exact(point_of(c.moving, p)) + moved - corner);
                gap = gap ? std::min(*gap, at) : at;
            }
            if (gap->sign() == 0) {
                const Point off = normal.cross(face);
                REQUIRE(off.dot(off) <= face.dot(face) * Rational::of(1, -40));
                ++landings;
            }
        }

        // The point lies on the triangle, and in the hull: between its ends along any axis.
        REQUIRE(contact.u >= 0.0f);
        REQUIRE(contact.v >= 0.0f);
        REQUIRE(contact.u + contact.v <= 1.0f + 0x1p-20f);
        // The part of the triangle with the exact point alone is touched at the same time.
        const float weights[3] = {1.0f - contact.u - contact.v, contact.u, contact.v};
        const unsigned of_part = detail::corners_of(contact.feature);
        Case<MovingHull> part = c;
        for (unsigned outside = 0; outside < 3; ++outside) {
            if ((of_part >> outside & 1u) != 0) continue;
            REQUIRE(std::fabs(weights[outside]) <= 0x1p-20f);
            for (unsigned other = 0; other < 3; ++other)
                if ((of_part >> other & 1u) != 0) part.triangle.corner[outside] = c.triangle.corner[other];
        }
        if (contact.feature != Feature::face) REQUIRE(exact_first_contact(part) == time);
        // No smaller part has it: the weights of b and c are rounded from exact ones.
        for (unsigned inside = 1; inside < 3; ++inside)
            if ((of_part >> inside & 1u) != 0) REQUIRE(weights[inside] > 0.0f);
        const Point point = weighted(c.triangle, contact);
        for (unsigned axis = 0; axis < 8; ++axis) {
            const Point along = axis == 0 ? normal : exact(Scene(random).some_point(4));
            std::optional<Rational> low, high;
            for (unsigned p = 0; p < c.moving.point_count; ++p) {
                const Rational at = along.dot(exact(point_of(c.moving, p)) + moved);
                low = low ? std::min(*low, at) : at;
                high = high ? std::max(*high, at) : at;
            }
            Rational length = 0;
            for (int k = 0; k < 3; ++k) length += oracle::absolute(along[k]);
            const Rational slack = length * size_of(c.triangle) * Rational::of(1, -20);
            REQUIRE(along.dot(point) >= *low - slack);
            REQUIRE(along.dot(point) <= *high + slack);
        }
    }
    for (const std::uint64_t number : seen) CHECK(number > count / 20);
    CHECK(landings > count / 20);
    MESSAGE(decisions_made("hull that moves", decided), ", ", landings, " on the triangle's plane");
}

TEST_CASE("kernel: a moving hull of as many vertices as are allowed touches at the tick of the oracle") {
    Random random(7);
    std::uint64_t hits = 0;
    for (std::uint64_t i = 0; i < scaled(20); ++i) {
        Case<MovingHull> c{};
        for (Integer3& corner : c.triangle.corner) {
            corner.x = random.between(-60, 60);
            corner.y = random.between(-60, 60);
            corner.z = random.between(-20, 20);
        }
        c.moving.displacement = {random.between(-40, 40), random.between(-40, 40), -120};
        while (c.moving.point_count < max_hull_vertices) {
            Integer3 at = {random.between(-50, 50), random.between(-50, 50), random.between(-50, 50)};
            const std::int64_t squared = at.x * at.x + at.y * at.y + at.z * at.z;
            at.z += 70;
            if (squared > 1900 && squared < 2500) add(c.moving, at);
        }
        const SweepTick tick = first_contact_tick(c.moving, c.triangle, whole_way);
        const std::optional<Rational> time = exact_first_contact(c);
        hits += require_tick(time, tick) ? 1u : 0u;
    }
    if (asks_enough()) CHECK(hits > 0);
}

TEST_CASE("kernel: the plane that a moving hull met before changes no contact") {
    Random random(8);
    std::uint64_t late = 0;
    for (std::uint64_t i = 0; i < scaled(2'000); ++i) {
        Case<MovingHull> c = some_hull(random);
        detail::PlaneAhead plane;
        SweepTick most = whole_way;
        for (int neighbour = 0; neighbour < 6; ++neighbour) {
            const SweepTick expected = first_contact_tick(c.moving, c.triangle, most);
            const bool has_plane = !plane.speed.is_zero();
            REQUIRE(first_contact_tick(c.moving, c.triangle, most, plane) == expected);
            if (expected != no_contact) most = expected;
            late += has_plane && expected == no_contact ? 1u : 0u;
            // The next one shares two corners, or is a little farther.
            const std::int64_t size = 1 + random.below(64);
            Integer3& corner = c.triangle.corner[random.below(3)];
            corner = random.coin() ? plus(corner, {size, -size, 1}) : plus(corner, {-1, size, size});
        }
    }
    if (asks_enough()) CHECK(late > 1'000);
}

}  // namespace
}  // namespace espalier::tests::moving_hull_test
