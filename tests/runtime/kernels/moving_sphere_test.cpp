// The kernel of moving spheres: the tick of the first contact, exactly, and the contact itself, against the oracle,
// which measures distances between hulls in rational numbers.
#include "support/testing.hpp"

#include <runtime/kernels/moving_shapes.hpp>
#include <runtime/kernels/segment_triangle.hpp>

#include "moving_scene.hpp"
#include "oracle/exact_geometry.hpp"
#include "oracle/rational.hpp"

namespace espalier::tests::moving_sphere_test {
namespace {

using namespace espalier::tests::moving;

Case<MovingSphere> some_sphere(Random& random) {
    for (;;) {
        Scene scene(random);
        const std::int64_t radius = scene.some_radius();
        const Integer3 way = scene.some_way();
        scene.see_from(scene.some_start(scene.some_target(), way, radius));
        if (scene.is_in_range(std::int64_t{1} << 34)) return {{way, radius}, scene.triangle};
    }
}

TEST_CASE("kernel: a moving sphere touches first at the tick of the oracle") {
    std::uint64_t decided = 0;
    Random random(1);
    std::array<std::uint64_t, 3> seen{};
    const std::uint64_t count = scaled(1'200);
    for (std::uint64_t i = 0; i < count; ++i) {
        const Case<MovingSphere> c = some_sphere(random);
        const SweepTick tick = first_contact_tick(c.moving, c.triangle, whole_way);
        CAPTURE(i);
        ++decided;
        require_right_tick(c, tick);
        require_right_limits(c, tick, random, seen);
    }
    for (const std::uint64_t number : seen) CHECK(number > count / 20);
    MESSAGE(decisions_made("sphere that moves", decided));
}

TEST_CASE("kernel: a moving sphere touches exactly where its segment comes within its radius") {
    Random random(2);
    std::uint64_t touched = 0, tried = 0;
    const std::uint64_t count = scaled(40'000);
    for (std::uint64_t i = 0; i < count; ++i) {
        const Case<MovingSphere> c = some_sphere(random);
        // Lattice triangles are small: those that fit are moved to where the lattice is.
        detail::LatticeTriangle triangle;
        detail::RoundedSegment path{};
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
        const SweepTick tick = first_contact_tick(c.moving, c.triangle, whole_way);
        REQUIRE((tick != no_contact) == within);
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
        const std::array<Point, 1> at = {center};
        REQUIRE(oracle::squared_distance(at, moving::corners_of(c.triangle, contact.feature)) ==
                closest.squared_distance);
        REQUIRE(is_smallest_part(at, c.triangle, contact.feature));
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

}  // namespace
}  // namespace espalier::tests::moving_sphere_test
