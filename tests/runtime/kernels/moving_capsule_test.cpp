// The kernel of moving capsules: the tick of the first contact, exactly, and the contact itself, against the oracle,
// which measures distances between hulls in rational numbers.
#include "support/testing.hpp"

#include <runtime/kernels/moving_shapes.hpp>

#include "moving_scene.hpp"
#include "support/exact/grid_triangles.hpp"
#include "oracle/exact_geometry.hpp"
#include "oracle/rational.hpp"

namespace espalier::tests::moving_capsule_test {
namespace {

using namespace espalier::tests::moving;

Case<MovingCapsule> some_capsule(Random& random) {
    for (;;) {
        Scene scene(random);
        const std::int64_t radius = scene.some_radius();
        const Integer3 way = scene.some_way();
        Integer3 axis = scene.some_point(scene.bits);
        const auto kind = random.below(5);
        if (kind == 0) axis = {0, 0, 0};
        else if (kind == 1) axis = minus(scene.triangle.corner[1], scene.triangle.corner[0]);
        else if (kind == 2) {
            axis.*axes[random.below(3)] = 0;
            axis.*axes[random.below(3)] = 0;
        }
        Integer3 start = scene.some_start(scene.some_target(), way, radius);
        if (random.coin()) start = minus(start, axis);
        scene.see_from(start);
        if (scene.is_in_range(std::int64_t{1} << 34)) return {{{way, radius}, axis}, scene.triangle};
    }
}

TEST_CASE("kernel: a moving capsule touches first at the tick of the oracle") {
    std::uint64_t decided = 0;
    Random random(4);
    std::array<std::uint64_t, 3> seen{};
    const std::uint64_t count = scaled(300);  // 284 meets two faces of the prism within one tick
    for (std::uint64_t i = 0; i < count; ++i) {
        const Case<MovingCapsule> c = some_capsule(random);
        CAPTURE(i);
        if (touches_at_start(c)) {
            ++seen[0];
            continue;
        }
        const SweepTick tick = first_contact_tick(c.moving, c.triangle, whole_way);
        REQUIRE(tick > 0);
        ++decided;
        require_right_tick(c, tick);
        require_right_limits(c, tick, random, seen);
        if (tick == no_contact || !has_area(c.triangle)) continue;
        // The named point is on the triangle and as far from the axis as the normal says.
        const SweepContact contact = contact_at(c.moving, c.triangle, tick);
        const Point start = exact(c.moving.sphere.displacement) * ticks(detail::tick_before(tick));
        const std::array<Point, 2> axis = {start, start + exact(c.moving.axis)};
        const Point point = weighted(c.triangle, contact);
        const std::array<Point, 1> named = {point};
        const Rational distance = oracle::squared_distance(axis, exact(c.triangle));
        const Rational from_point = oracle::squared_distance(axis, named);
        REQUIRE(oracle::squared_distance(axis, moving::corners_of(c.triangle, contact.feature)) == distance);
        // Of a capsule whose axis is parallel to a face several parts are equally near.
        if (is_zero(c.moving.axis)) REQUIRE(moving::is_smallest_part(axis, c.triangle, contact.feature));
        // The other end of the shortest connection: along the normal.
        const Rational slack = (size_of(c.triangle) + length_bound(c.moving.axis)) * Rational::of(1, -20);
        const Rational way_of_tick = length_bound(c.moving.sphere.displacement) * ticks(1);
        REQUIRE(is_root_within(from_point, distance, slack + way_of_tick));
    }
    for (const std::uint64_t number : seen) CHECK(number > count / 20);
    MESSAGE(decisions_made("capsule that moves", decided));
}

TEST_CASE("kernel: a capsule leaves a triangle exactly if its axis gets no nearer") {
    Random random(41);
    std::array<std::uint64_t, 3> seen{};
    const std::uint64_t count = scaled(400);
    for (std::uint64_t i = 0; i < count; ++i) {
        Case<MovingCapsule> c = some_capsule(random);
        if (random.coin()) c.moving.axis = {0, 0, 0};
        CAPTURE(i);
        // Near the triangle; then the axis comes nearer within the shortest time, or never.
        if (random.coin())
            for (Integer3& corner : c.triangle.corner) corner = plus(corner, Scene(random).some_point(3));
        const auto distance_at = [&](const Rational& time) {
            const Point start = exact(c.moving.sphere.displacement) * time;
            const std::array<Point, 2> axis = {start, start + exact(c.moving.axis)};
            return oracle::squared_distance(axis, exact(c.triangle));
        };
        const Rational before = distance_at(0), soon = distance_at(Rational::of(1, -240));
        const bool leaves = before.sign() > 0 && soon >= before;
        REQUIRE(leaves_at_start(c.moving, c.triangle) == leaves);
        ++seen[before.sign() == 0 ? 0 : leaves ? 1 : 2];
    }
    if (asks_enough())
        for (const std::uint64_t number : seen) CHECK(number > count / 100);
}

}  // namespace
}  // namespace espalier::tests::moving_capsule_test
