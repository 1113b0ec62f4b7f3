// Triangles and shapes that move towards them, for tests of the kernels of sweeps.
#pragma once

#include "support/testing.hpp"

#include <runtime/kernels/moving_shapes.hpp>

#include "oracle/exact_geometry.hpp"
#include "oracle/rational.hpp"

namespace espalier::tests::moving {

using detail::Integer3;
using detail::IntegerTriangle;
using detail::MovingCapsule;
using detail::MovingSphere;
using detail::no_contact;
using detail::SweepContact;
using detail::SweepTick;
using detail::whole_way;
using oracle::Point;
using oracle::Rational;

inline constexpr std::int64_t Integer3::*axes[3] = {&Integer3::x, &Integer3::y, &Integer3::z};

inline Integer3 plus(const Integer3& a, const Integer3& b) { return a + b; }
inline Integer3 minus(const Integer3& a, const Integer3& b) { return a - b; }

inline Point exact(const Integer3& a) { return Point(Rational(a.x), Rational(a.y), Rational(a.z)); }
inline std::array<Point, 3> exact(const IntegerTriangle& t) {
    return {exact(t.corner[0]), exact(t.corner[1]), exact(t.corner[2])};
}
inline Rational ticks(std::uint32_t count) { return Rational::of(std::int64_t{count}, -detail::tick_bits); }

inline bool is_below(const Integer3& a, std::int64_t limit) {
    return std::all_of(std::begin(axes), std::end(axes),
                       [&](auto axis) { return a.*axis < limit && a.*axis > -limit; });
}

inline bool has_area(const IntegerTriangle& t) {
    const Integer3 n = cross(minus(t.corner[1], t.corner[0]), minus(t.corner[2], t.corner[0]));
    return n.x != 0 || n.y != 0 || n.z != 0;
}

/// A triangle and a place to aim at, with coordinates of some number of bits: fat, slim, flat in an axis, without area.
struct Scene {
    Random& random;
    unsigned bits;
    IntegerTriangle triangle;

    explicit Scene(Random& generator) : random(generator), bits(1 + generator.below(24)) {
        for (Integer3& corner : triangle.corner) corner = some_point(bits);
        const auto kind = random.below(8);
        if (kind == 0)
            for (Integer3& corner : triangle.corner) corner.z = triangle.corner[0].z;
        else if (kind == 1) triangle.corner[2] = middle(triangle.corner[0], triangle.corner[1]);
        else if (kind == 2) triangle.corner[1] = triangle.corner[0];
        else if (kind == 3) {  // one right angle along the axes
            triangle.corner[1] = {triangle.corner[0].x + 1 + random.below(1u << bits), triangle.corner[0].y,
                                  triangle.corner[0].z};
            triangle.corner[2] = {triangle.corner[0].x, triangle.corner[0].y + 1 + random.below(1u << bits),
                                  triangle.corner[0].z};
        }
    }

    Integer3 some_point(unsigned size) {
        const auto limit = static_cast<std::int32_t>(1u << size);
        const std::int64_t x = random.between(-limit, limit);
        const std::int64_t y = random.between(-limit, limit);
        return {x, y, random.between(-limit, limit)};
    }
    static Integer3 middle(const Integer3& a, const Integer3& b) {
        return {(a.x + b.x) >> 1, (a.y + b.y) >> 1, (a.z + b.z) >> 1};
    }
    /// A corner, the middle of a side, a point of the face, or somewhere near.
    Integer3 some_target() {
        const auto& c = triangle.corner;
        const auto kind = random.below(4);
        if (kind == 0) return c[random.below(3)];
        if (kind == 1) return middle(c[random.below(3)], c[random.below(3)]);
        if (kind == 2) return middle(middle(c[0], c[1]), c[2]);
        return some_point(bits);
    }
    /// Along an axis, along a side, in any direction, far or short, or nowhere.
    Integer3 some_way() {
        const Integer3 side = minus(triangle.corner[1], triangle.corner[0]);
        switch (random.below(8)) {
            case 0:
                return {0, 0, 0};
            case 1:
            case 2: {
                Integer3 way = {0, 0, 0};
                way.*axes[random.below(3)] = random.between(-(1 << bits), 1 << bits) * std::int64_t{2};
                return way;
            }
            case 3:
                return side;
            case 4:
                return {2 * side.y, -2 * side.x, 0};
            case 5: {
                const Integer3 way = some_point(bits);
                const std::int64_t factor = std::int64_t{1} << random.below(34 - bits);
                return {way.x * factor, way.y * factor, way.z * factor};
            }
            default:
                return some_point(std::min(bits + 1, 24u));
        }
    }
    std::int64_t some_radius() {
        const auto kind = random.below(6);
        if (kind == 0) return 0;
        if (kind == 1) return 1;
        if (kind == 2) return 5 * std::int64_t{1 + random.below(1u << bits)};
        if (kind == 3) return std::int64_t{random.below(1u << bits)} << random.below(34 - bits);
        return std::int64_t{random.below(1u << bits)};
    }
    /// So far from the target that it may just be touched on the way: a multiple of (3, 4, 0) for the sphere of a
    /// multiple of 5, the radius along an axis, or anything.
    Integer3 some_offset(std::int64_t radius) {
        Integer3 off = {0, 0, 0};
        const unsigned k = random.below(3);
        const auto kind = random.below(4);
        if (kind == 0) {
            off.*axes[k] = random.coin() ? radius / 5 * 3 : -radius / 5 * 3;
            off.*axes[(k + 1) % 3] = random.coin() ? radius / 5 * 4 : -radius / 5 * 4;
        } else if (kind == 1) {
            off.*axes[k] = random.coin() ? radius : -radius;
        } else if (kind == 2) {
            off = some_point(bits);
        }
        return off;
    }
    /// So that the target is passed somewhere on the way, at a start or end of it as often as within.
    Integer3 some_start(const Integer3& target, const Integer3& way, std::int64_t radius) {
        const Integer3 at = plus(target, some_offset(radius));
        switch (random.below(5)) {
            case 0:
                return at;
            case 1:
                return minus(at, way);
            case 2:
                return minus(at, middle(way, {0, 0, 0}));
            default:
                return minus(at, middle(way, plus(middle(way, {0, 0, 0}), some_point(std::min(bits, 6u)))));
        }
    }
    void see_from(const Integer3& start) {
        for (Integer3& corner : triangle.corner) corner = minus(corner, start);
    }
    [[nodiscard]] bool is_in_range(std::int64_t limit) const {
        return std::ranges::all_of(triangle.corner, [&](const Integer3& c) { return is_below(c, limit); });
    }
};

template <class Moving>
struct Case {
    Moving moving;
    IntegerTriangle triangle;
};

/// Whether the sphere, or the capsule, touches the triangle at some time between two ticks.
inline bool touches_between(const MovingSphere& sphere, const IntegerTriangle& triangle, std::uint32_t from,
                            std::uint32_t to) {
    const std::array<Point, 2> path = {exact(sphere.displacement) * ticks(from),
                                       exact(sphere.displacement) * ticks(to)};
    return oracle::squared_distance(path, exact(triangle)) <= Rational(sphere.radius) * Rational(sphere.radius);
}
inline bool touches_between(const MovingCapsule& capsule, const IntegerTriangle& triangle, std::uint32_t from,
                            std::uint32_t to) {
    const Point way = exact(capsule.sphere.displacement);
    const Point axis = exact(capsule.axis);
    const std::array<Point, 3> first = {way * ticks(from), way * ticks(from) + axis, way * ticks(to)};
    const std::array<Point, 3> second = {way * ticks(from) + axis, way * ticks(to), way * ticks(to) + axis};
    const Rational bound = Rational(capsule.sphere.radius) * Rational(capsule.sphere.radius);
    return oracle::squared_distance(first, exact(triangle)) <= bound ||
           oracle::squared_distance(second, exact(triangle)) <= bound;
}

template <class Moving>
bool touches_at_start(const Case<Moving>& c) {
    return touches_between(c.moving, c.triangle, 0, 0);
}

template <class Moving>
void require_right_tick(const Case<Moving>& c, SweepTick tick) {
    if (tick == no_contact) {
        REQUIRE_FALSE(touches_between(c.moving, c.triangle, 0, whole_way));
    } else if (tick == 0) {
        REQUIRE(touches_at_start(c));
    } else {
        REQUIRE(tick <= whole_way);
        REQUIRE_FALSE(touches_between(c.moving, c.triangle, 0, tick - 1));
        REQUIRE(touches_between(c.moving, c.triangle, tick - 1, tick));
    }
}

/// A limit changes nothing but that later contacts are none. Counts the contact: at the start, none, or later.
template <class Moving>
void require_right_limits(const Case<Moving>& c, SweepTick tick, Random& random, std::array<std::uint64_t, 3>& seen) {
    ++seen[tick == 0 ? 0 : tick == no_contact ? 1 : 2];
    const SweepTick near = tick == no_contact ? whole_way : tick;
    for (const SweepTick most : {near, near == 0 ? 0 : near - 1, random.below(whole_way + 1)})
        REQUIRE(first_contact_tick(c.moving, c.triangle, most) == (tick <= most ? tick : no_contact));
}

/// Requires the tick in which an exact time lies. Returns whether that is after the start.
inline bool require_tick(const std::optional<Rational>& time, SweepTick tick) {
    REQUIRE(time.has_value() == (tick != no_contact));
    if (!time) return false;
    REQUIRE((time->sign() == 0) == (tick == 0));
    if (tick == 0) return false;
    REQUIRE(*time <= ticks(tick));
    REQUIRE(*time > ticks(tick - 1));
    return true;
}

/// Returns the normal of a contact, which must be of unit length and look against the way.
inline Point require_normal(const SweepContact& contact, const Point& way) {
    const Point normal(Rational::of(contact.normal.x), Rational::of(contact.normal.y), Rational::of(contact.normal.z));
    REQUIRE(normal.dot(way).sign() < 0);
    REQUIRE(oracle::absolute(normal.dot(normal) - Rational(1)) <= Rational::of(1, -21));
    return normal;
}

/// The corners of a part of the triangle.
inline std::vector<Point> corners_of(const IntegerTriangle& triangle, Feature part) {
    const std::vector<std::vector<int>> corners = {{0, 1, 2}, {0, 1}, {1, 2}, {2, 0}, {0}, {1}, {2}};
    std::vector<Point> result;
    for (const int i : corners[static_cast<std::size_t>(part)]) result.push_back(exact(triangle)[std::size_t(i)]);
    return result;
}
/// Whether the parts that a part of the triangle ends in are farther away than it is.
template <class Points>
bool is_smallest_part(const Points& shape, const IntegerTriangle& triangle, Feature part) {
    const std::vector<Point> corners = corners_of(triangle, part);
    const Rational distance = oracle::squared_distance(shape, corners);
    if (corners.size() == 1) return true;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        std::vector<Point> less = corners;
        less.erase(less.begin() + static_cast<std::ptrdiff_t>(i));
        if (oracle::squared_distance(shape, less) <= distance) return false;
    }
    return true;
}

/// Whether a coordinate of a / |a| is within 4 ulp of 1 of the number.
inline bool is_coordinate_of_unit(const Rational& a, const Rational& squared_length, float number) {
    const Rational error = Rational::of(4, -24);
    const auto at_most = [&](const Rational& sign, const Rational& bound) {  // sign * a / |a| <= bound
        const Rational value = sign * a;
        if (bound.sign() < 0) return value.sign() < 0 && value * value >= bound * bound * squared_length;
        return value.sign() <= 0 || value * value <= bound * bound * squared_length;
    };
    return at_most(1, Rational::of(number) + error) && at_most(-1, error - Rational::of(number));
}
inline void require_unit_along(const Point& a, const Vec3& normal) {
    const Rational squared = a.dot(a);
    REQUIRE(is_coordinate_of_unit(a[0], squared, normal.x));
    REQUIRE(is_coordinate_of_unit(a[1], squared, normal.y));
    REQUIRE(is_coordinate_of_unit(a[2], squared, normal.z));
}

inline Point weighted(const IntegerTriangle& triangle, const SweepContact& contact) {
    const auto t = exact(triangle);
    return t[0] + (t[1] - t[0]) * Rational::of(contact.u) + (t[2] - t[0]) * Rational::of(contact.v);
}
/// No less than the length.
inline Rational length_bound(const Integer3& a) {
    return oracle::absolute(Rational(a.x)) + oracle::absolute(Rational(a.y)) + oracle::absolute(Rational(a.z));
}
inline Rational size_of(const IntegerTriangle& triangle) {
    Rational size = 0;
    const auto t = exact(triangle);
    for (int k = 0; k < 3; ++k) size += oracle::absolute(t[1][k] - t[0][k]) + oracle::absolute(t[2][k] - t[0][k]);
    return size;
}

}  // namespace espalier::tests::moving
