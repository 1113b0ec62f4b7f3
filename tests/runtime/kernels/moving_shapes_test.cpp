// Claims about the kernels of sweeps: the tick of the first contact, exactly, and what is said about it, against the
// oracle, which measures distances between hulls and solves linear programs in rational numbers.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <runtime/moving_box.hpp>
#include <runtime/moving_capsule.hpp>
#include <runtime/moving_sphere.hpp>
#include <runtime/segment_triangle.hpp>

#include "oracle/exact_geometry.hpp"
#include "support/base/calls.hpp"
#include "support/base/random.hpp"
#include "support/base/test_scale.hpp"

using namespace espalier;
using detail::Integer3;
using detail::IntegerTriangle;
using detail::MovingBox;
using detail::MovingCapsule;
using detail::MovingSphere;
using detail::no_contact;
using detail::SweepContact;
using detail::SweepStep;
using detail::whole_way;
using oracle::BigInteger;
using oracle::Point;
using oracle::Rational;
using tests::decisions_made;
using tests::Random;
using tests::scaled;

namespace {

constexpr std::int64_t Integer3::*axes[3] = {&Integer3::x, &Integer3::y, &Integer3::z};

Integer3 plus(const Integer3& a, const Integer3& b) { return a + b; }
Integer3 minus(const Integer3& a, const Integer3& b) { return a - b; }

Point exact(const Integer3& a) { return Point(Rational(a.x), Rational(a.y), Rational(a.z)); }
std::array<Point, 3> exact(const IntegerTriangle& t) {
    return {exact(t.corner[0]), exact(t.corner[1]), exact(t.corner[2])};
}
Rational ticks(std::uint32_t count) { return Rational::of(std::int64_t{count}, -detail::tick_bits); }

bool has_area(const IntegerTriangle& t) {
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
        switch (random.below(8)) {
            case 0:
                for (Integer3& corner : triangle.corner) corner.z = triangle.corner[0].z;
                break;
            case 1:
                triangle.corner[2] = middle(triangle.corner[0], triangle.corner[1]);
                break;
            case 2:
                triangle.corner[1] = triangle.corner[0];
                break;
            case 3:  // one right angle along the axes
                triangle.corner[1] = {triangle.corner[0].x + 1 + random.below(1u << bits), triangle.corner[0].y,
                                      triangle.corner[0].z};
                triangle.corner[2] = {triangle.corner[0].x, triangle.corner[0].y + 1 + random.below(1u << bits),
                                      triangle.corner[0].z};
                break;
            default:
                break;
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
        switch (random.below(4)) {
            case 0:
                return c[random.below(3)];
            case 1:
                return middle(c[random.below(3)], c[random.below(3)]);
            case 2:
                return middle(middle(c[0], c[1]), c[2]);
            default:
                return some_point(bits);
        }
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
        switch (random.below(6)) {
            case 0:
                return 0;
            case 1:
                return 1;
            case 2:
                return 5 * std::int64_t{1 + random.below(1u << bits)};
            case 3:
                return std::int64_t{random.below(1u << bits)} << random.below(34 - bits);
            default:
                return std::int64_t{random.below(1u << bits)};
        }
    }
    /// So far from the target that it may just be touched on the way: a multiple of (3, 4, 0) for the sphere of a
    /// multiple of 5, the radius along an axis, or anything.
    Integer3 some_offset(std::int64_t radius) {
        Integer3 off = {0, 0, 0};
        const unsigned k = random.below(3);
        switch (random.below(4)) {
            case 0:
                off.*axes[k] = random.coin() ? radius / 5 * 3 : -radius / 5 * 3;
                off.*axes[(k + 1) % 3] = random.coin() ? radius / 5 * 4 : -radius / 5 * 4;
                break;
            case 1:
                off.*axes[k] = random.coin() ? radius : -radius;
                break;
            case 2:
                off = some_point(bits);
                break;
            default:
                break;
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
        return std::all_of(std::begin(triangle.corner), std::end(triangle.corner), [&](const Integer3& c) {
            return std::all_of(std::begin(axes), std::end(axes),
                               [&](auto axis) { return c.*axis < limit && c.*axis > -limit; });
        });
    }
};

template <class Moving>
struct Case {
    Moving moving;
    IntegerTriangle triangle;
};

Case<MovingSphere> some_sphere(Random& random) {
    for (;;) {
        Scene scene(random);
        const std::int64_t radius = scene.some_radius();
        const Integer3 way = scene.some_way();
        scene.see_from(scene.some_start(scene.some_target(), way, radius));
        if (scene.is_in_range(std::int64_t{1} << 34)) return {{way, radius}, scene.triangle};
    }
}

Case<MovingCapsule> some_capsule(Random& random) {
    for (;;) {
        Scene scene(random);
        const std::int64_t radius = scene.some_radius();
        const Integer3 way = scene.some_way();
        Integer3 axis = scene.some_point(scene.bits);
        switch (random.below(5)) {
            case 0:
                axis = {0, 0, 0};
                break;
            case 1:
                axis = minus(scene.triangle.corner[1], scene.triangle.corner[0]);
                break;
            case 2:
                axis.*axes[random.below(3)] = 0;
                axis.*axes[random.below(3)] = 0;
                break;
            default:
                break;
        }
        Integer3 start = scene.some_start(scene.some_target(), way, radius);
        if (random.coin()) start = minus(start, axis);
        scene.see_from(start);
        if (scene.is_in_range(std::int64_t{1} << 34)) return {{{way, radius}, axis}, scene.triangle};
    }
}

Case<MovingBox> some_box(Random& random) {
    for (;;) {
        Scene scene(random);
        const Integer3 way = scene.some_way();
        Integer3 size = {scene.some_radius(), scene.some_radius(), scene.some_radius()};
        const Integer3 low =
            minus(scene.some_start(scene.some_target(), way, size.x), random.coin() ? size : Integer3{});
        const Integer3 high = plus(low, size);
        const auto is_small = [](const Integer3& a) {
            return std::all_of(std::begin(axes), std::end(axes), [&](auto axis) {
                return a.*axis < std::int64_t{1} << 34 && a.*axis > -(std::int64_t{1} << 34);
            });
        };
        if (is_small(low) && is_small(high)) return {{low, high, way}, scene.triangle};
    }
}

/// Whether the sphere, or the capsule, touches the triangle at some time between two ticks.
bool touches_between(const MovingSphere& sphere, const IntegerTriangle& triangle, std::uint32_t from,
                     std::uint32_t to) {
    const std::array<Point, 2> path = {exact(sphere.displacement) * ticks(from),
                                       exact(sphere.displacement) * ticks(to)};
    return oracle::squared_distance(path, exact(triangle)) <= Rational(sphere.radius) * Rational(sphere.radius);
}
bool touches_between(const MovingCapsule& capsule, const IntegerTriangle& triangle, std::uint32_t from,
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
void require_right_step(const Case<Moving>& c, SweepStep step) {
    if (step == no_contact) {
        REQUIRE_FALSE(touches_between(c.moving, c.triangle, 0, whole_way));
    } else if (step == 0) {
        REQUIRE(touches_at_start(c));
    } else {
        REQUIRE(step <= whole_way);
        REQUIRE_FALSE(touches_between(c.moving, c.triangle, 0, step - 1));
        REQUIRE(touches_between(c.moving, c.triangle, step - 1, step));
    }
}

/// A limit changes nothing but that later contacts are none.
template <class Moving>
void require_right_limits(const Case<Moving>& c, SweepStep step, Random& random) {
    const SweepStep near = step == no_contact ? whole_way : step;
    for (const SweepStep most : {near, near == 0 ? 0 : near - 1, random.below(whole_way + 1)})
        REQUIRE(first_contact(c.moving, c.triangle, most) == (step <= most ? step : no_contact));
}

/// Whether a coordinate of a / |a| is within 4 ulp of 1 of the number.
bool is_coordinate_of_unit(const Rational& a, const Rational& squared_length, float number) {
    const Rational error = Rational::of(4, -24);
    const auto at_most = [&](const Rational& sign, const Rational& bound) {  // sign * a / |a| <= bound
        const Rational value = sign * a;
        if (bound.sign() < 0) return value.sign() < 0 && value * value >= bound * bound * squared_length;
        return value.sign() <= 0 || value * value <= bound * bound * squared_length;
    };
    return at_most(1, Rational::of(number) + error) && at_most(-1, error - Rational::of(number));
}
void require_unit_along(const Point& a, const Vec3& normal) {
    const Rational squared = a.dot(a);
    REQUIRE(is_coordinate_of_unit(a[0], squared, normal.x));
    REQUIRE(is_coordinate_of_unit(a[1], squared, normal.y));
    REQUIRE(is_coordinate_of_unit(a[2], squared, normal.z));
}

Point weighted(const IntegerTriangle& triangle, const SweepContact& contact) {
    const auto t = exact(triangle);
    return t[0] + (t[1] - t[0]) * Rational::of(contact.u) + (t[2] - t[0]) * Rational::of(contact.v);
}
/// No less than the length.
Rational length_bound(const Integer3& a) {
    return oracle::absolute(Rational(a.x)) + oracle::absolute(Rational(a.y)) + oracle::absolute(Rational(a.z));
}
Rational size_of(const IntegerTriangle& triangle) {
    Rational size = 0;
    const auto t = exact(triangle);
    for (int k = 0; k < 3; ++k) size += oracle::absolute(t[1][k] - t[0][k]) + oracle::absolute(t[2][k] - t[0][k]);
    return size;
}

/// Minimises tau over all u, v, tau with a point of the triangle in the moved box: at a corner of that polytope, where
/// three of its planes meet. Its planes: normal * (u, v, tau) <= bound.
std::optional<Rational> exact_first_contact(const Case<MovingBox>& c) {
    struct Plane {
        std::array<BigInteger, 3> normal;
        BigInteger bound;
    };
    std::vector<Plane> planes = {{{-1, 0, 0}, 0}, {{0, -1, 0}, 0}, {{1, 1, 0}, 1}, {{0, 0, -1}, 0}, {{0, 0, 1}, 1}};
    for (const auto axis : axes) {
        const auto& t = c.triangle.corner;
        const BigInteger u = t[1].*axis - t[0].*axis, v = t[2].*axis - t[0].*axis, way = c.moving.displacement.*axis;
        planes.push_back({{u, v, -way}, c.moving.high.*axis - t[0].*axis});
        planes.push_back({{-u, -v, way}, t[0].*axis - c.moving.low.*axis});
    }
    const auto determinant = [](const std::array<BigInteger, 3>& a, const std::array<BigInteger, 3>& b,
                                const std::array<BigInteger, 3>& d) {
        return a[0] * (b[1] * d[2] - b[2] * d[1]) - a[1] * (b[0] * d[2] - b[2] * d[0]) +
               a[2] * (b[0] * d[1] - b[1] * d[0]);
    };
    std::optional<std::pair<BigInteger, BigInteger>> least;
    for (std::size_t i = 0; i < planes.size(); ++i)
        for (std::size_t j = i + 1; j < planes.size(); ++j)
            for (std::size_t k = j + 1; k < planes.size(); ++k) {
                const Plane* three[3] = {&planes[i], &planes[j], &planes[k]};
                BigInteger whole = determinant(three[0]->normal, three[1]->normal, three[2]->normal);
                if (whole.is_zero()) continue;
                std::array<BigInteger, 3> at;
                for (unsigned column = 0; column < 3; ++column) {
                    std::array<BigInteger, 3> rows[3] = {three[0]->normal, three[1]->normal, three[2]->normal};
                    for (unsigned row = 0; row < 3; ++row) rows[row][column] = three[row]->bound;
                    at[column] = determinant(rows[0], rows[1], rows[2]);
                }
                if (whole.is_negative()) {
                    whole = -whole;
                    for (BigInteger& coordinate : at) coordinate = -coordinate;
                }
                const bool is_inside = std::all_of(planes.begin(), planes.end(), [&](const Plane& plane) {
                    return plane.normal[0] * at[0] + plane.normal[1] * at[1] + plane.normal[2] * at[2] <=
                           plane.bound * whole;
                });
                if (is_inside && (!least || at[2] * least->second < least->first * whole)) least = {at[2], whole};
            }
    if (!least) return std::nullopt;
    return Rational(least->first, least->second);
}

}  // namespace

TEST_SUITE("moving shapes") {
    TEST_CASE("kernel: a moving sphere touches first at the tick of the oracle") {
        std::uint64_t decided = 0;
        Random random(1);
        std::array<std::uint64_t, 3> seen{};
        const std::uint64_t count = scaled(1'200);
        for (std::uint64_t i = 0; i < count; ++i) {
            const Case<MovingSphere> c = some_sphere(random);
            const SweepStep step = first_contact(c.moving, c.triangle, whole_way);
            CAPTURE(i);
            ++decided;
            require_right_step(c, step);
            require_right_limits(c, step, random);
            ++seen[step == 0 ? 0 : step == no_contact ? 1 : 2];
        }
        for (const std::uint64_t number : seen) CHECK(number > count / 20);
        MESSAGE(decisions_made("sphere that moves", decided));
    }

    TEST_CASE("kernel: a moving sphere touches exactly where its segment comes within its radius") {
        Random random(2);
        std::uint64_t touched = 0;
        std::uint64_t tried = 0;
        const std::uint64_t count = scaled(40'000);
        for (std::uint64_t i = 0; i < count; ++i) {
            const Case<MovingSphere> c = some_sphere(random);
            // Lattice triangles are small: those that fit are moved to where the lattice is.
            detail::LatticeTriangle triangle;
            detail::LatticeSegment path{};
            bool fits = true;
            for (unsigned k = 0; k < 3; ++k) {
                const auto& t = c.triangle.corner;
                const std::int64_t low = std::min({t[0].*axes[k], t[1].*axes[k], t[2].*axes[k]});
                for (unsigned j = 0; j < 3; ++j) {
                    fits = fits && t[j].*axes[k] - low < (1 << 24);
                    triangle.corner[j][k] = static_cast<std::int32_t>(t[j].*axes[k] - low);
                }
                path.from[k] = -low;
                path.to[k] = c.moving.displacement.*axes[k] - low;
            }
            if (!fits) continue;
            ++tried;
            CAPTURE(i);
            const bool within =
                is_within_radius(path, triangle, distance_to(path, triangle), static_cast<float>(c.moving.radius));
            if (static_cast<std::int64_t>(static_cast<float>(c.moving.radius)) != c.moving.radius) continue;
            const SweepStep step = first_contact(c.moving, c.triangle, whole_way);
            REQUIRE((step != no_contact) == within);
            touched += within ? 1 : 0;
        }
        CHECK(tried > count / 2);
        CHECK(touched > count / 4);
    }

    TEST_CASE("kernel: the contact of a sphere is the closest point and its normal leads to the centre") {
        Random random(3);
        const std::uint64_t count = scaled(1'500);
        std::uint64_t apart = 0;
        for (std::uint64_t i = 0; i < count; ++i) {
            const Case<MovingSphere> c = some_sphere(random);
            if (!has_area(c.triangle)) continue;
            const std::uint32_t tick = random.coin() ? 0 : random.below(whole_way + 1);
            const SweepContact contact = contact_at(c.moving, c.triangle, tick);
            CAPTURE(i);
            const Point center = exact(c.moving.displacement) * ticks(tick);
            const auto t = exact(c.triangle);
            const oracle::ClosestPoint closest = oracle::closest_on_triangle({t[0], t[1], t[2]}, center);
            const Point off = weighted(c.triangle, contact) - closest.point;
            const Rational allowed = size_of(c.triangle) * Rational::of(1, -21);
            for (int k = 0; k < 3; ++k) REQUIRE(oracle::absolute(off[k]) <= allowed);
            REQUIRE(contact.u >= 0.0f);
            REQUIRE(contact.v >= 0.0f);
            if (closest.squared_distance.sign() != 0) {
                ++apart;
                require_unit_along(center - closest.point, contact.normal);
            } else {
                const Point normal = oracle::normal_of({t[0], t[1], t[2]});
                const bool along = normal.dot(exact(c.moving.displacement)).sign() > 0;
                require_unit_along(along ? Point(-normal) : normal, contact.normal);
            }
        }
        CHECK(apart > count / 4);
    }

    TEST_CASE("kernel: a moving capsule touches first at the tick of the oracle") {
        std::uint64_t decided = 0;
        Random random(4);
        std::array<std::uint64_t, 3> seen{};
        const std::uint64_t count = scaled(250);
        for (std::uint64_t i = 0; i < count; ++i) {
            const Case<MovingCapsule> c = some_capsule(random);
            CAPTURE(i);
            if (touches_at_start(c)) {
                ++seen[0];
                continue;
            }
            const SweepStep step = first_contact(c.moving, c.triangle, whole_way);
            REQUIRE(step > 0);
            ++decided;
            require_right_step(c, step);
            require_right_limits(c, step, random);
            ++seen[step == no_contact ? 1 : 2];
            if (step == no_contact || !has_area(c.triangle)) continue;
            // The named point is on the triangle and as far from the axis as the normal says.
            const SweepContact contact = contact_at(c.moving, c.triangle, step);
            const Point start = exact(c.moving.sphere.displacement) * ticks(detail::tick_before(step));
            const std::array<Point, 2> axis = {start, start + exact(c.moving.axis)};
            const Point point = weighted(c.triangle, contact);
            const std::array<Point, 1> named = {point};
            const Rational distance = oracle::squared_distance(axis, exact(c.triangle));
            const Rational from_point = oracle::squared_distance(axis, named);
            // The other end of the shortest connection: along the normal.
            const Rational slack = (size_of(c.triangle) + length_bound(c.moving.axis)) * Rational::of(1, -20);
            // sqrt(from_point) <= sqrt(distance) + slack + the way of a tick, squared twice.
            const Rational way = length_bound(c.moving.sphere.displacement) * ticks(1);
            const Rational more = slack + way;
            const Rational above = from_point - distance - more * more;
            REQUIRE((above.sign() <= 0 || above * above <= Rational(4) * more * more * distance));
        }
        for (const std::uint64_t number : seen) CHECK(number > count / 20);
        MESSAGE(decisions_made("capsule that moves", decided));
    }

    TEST_CASE("kernel: a moving box touches first at the tick of the oracle") {
        std::uint64_t decided = 0;
        Random random(5);
        std::array<std::uint64_t, 3> seen{};
        const std::uint64_t count = scaled(1'500);
        for (std::uint64_t i = 0; i < count; ++i) {
            const Case<MovingBox> c = some_box(random);
            const SweepStep step = first_contact(c.moving, c.triangle, whole_way);
            const std::optional<Rational> time = exact_first_contact(c);
            CAPTURE(i);
            ++decided;
            REQUIRE(time.has_value() == (step != no_contact));
            require_right_limits(c, step, random);
            ++seen[step == 0 ? 0 : step == no_contact ? 1 : 2];
            if (!time) continue;
            REQUIRE((time->sign() == 0) == (step == 0));
            if (step == 0) continue;
            REQUIRE(*time <= ticks(step));
            REQUIRE(*time > ticks(step - 1));

            // The normal separates, and looks against the way.
            const SweepContact contact = contact_at(c.moving, c.triangle, step);
            const Point normal(Rational::of(contact.normal.x), Rational::of(contact.normal.y),
                               Rational::of(contact.normal.z));
            const Point way = exact(c.moving.displacement);
            REQUIRE(normal.dot(way).sign() < 0);
            REQUIRE(oracle::absolute(normal.dot(normal) - Rational(1)) <= Rational::of(1, -21));
            const Point moved = way * ticks(step - 1);
            Rational of_box = normal.dot(moved);
            Rational size = 0;
            for (int k = 0; k < 3; ++k) {
                const auto axis = axes[k];
                const std::int64_t low = c.moving.low.*axis, high = c.moving.high.*axis;
                of_box += normal[k] * Rational(normal[k].sign() > 0 ? low : high);
                size = std::max(
                    {size, oracle::absolute(Rational(low) + moved[k]), oracle::absolute(Rational(high) + moved[k])});
            }
            Rational of_triangle = normal.dot(exact(c.triangle.corner[0]));
            for (const Integer3& corner : c.triangle.corner) {
                of_triangle = std::max(of_triangle, normal.dot(exact(corner)));
                for (const auto axis : axes) size = std::max(size, oracle::absolute(Rational(corner.*axis)));
            }
            REQUIRE(of_box >= of_triangle - size * Rational::of(1, -20));

            // The point lies on the triangle and in the box, as far as the header says.
            const Point point = weighted(c.triangle, contact);
            REQUIRE(contact.u >= -0x1p-20f);
            REQUIRE(contact.v >= -0x1p-20f);
            REQUIRE(contact.u + contact.v <= 1.0f + 0x1p-20f);
            for (int k = 0; k < 3; ++k) {
                const auto axis = axes[k];
                const Rational low = Rational(c.moving.low.*axis) + moved[k];
                const Rational high = Rational(c.moving.high.*axis) + moved[k];
                Rational largest = 0;
                for (const Integer3& corner : c.triangle.corner)
                    largest = std::max({largest, oracle::absolute(Rational(corner.*axis) - low),
                                        oracle::absolute(Rational(corner.*axis) - high)});
                const Rational grown = oracle::absolute(way[k]) * ticks(1) + largest * Rational::of(1, -19);
                REQUIRE(point[k] >= low - grown);
                REQUIRE(point[k] <= high + grown);
            }
        }
        for (const std::uint64_t number : seen) CHECK(number > count / 20);
        MESSAGE(decisions_made("box that moves", decided));
    }
}
