// Claims about the ray kernel: on the rounded ray its yes and no are those of exact rational arithmetic, its numbers
// close.
#include "support/testing.hpp"

#include <runtime/kernels/ray_triangle.hpp>
#include <runtime/kernels/small_ray_triangle.hpp>

#include "support/exact/as_rationals.hpp"
#include "support/exact/grid_triangles.hpp"

namespace espalier::tests::ray_triangle_test {
namespace {

using detail::LatticeRay;

/// Also by the kernel of small cores: all that the caller sees of a hit must have the same bits.
bool both_intersect(const LatticeRay& ray, const detail::LatticeTriangle& triangle, detail::TriangleHit& hit) {
    detail::TriangleHit of_small_cores{};
    detail::LatticeTriangle from_origin = triangle;
    for (auto& corner : from_origin.corner)
        for (int k = 0; k < 3; ++k) corner[k] = (corner[k] << ray.fraction_bits) - ray.origin[k];
    const bool hits = detail::intersect(ray, triangle, hit);
    REQUIRE(detail::small_ray_triangle::hits(ray, from_origin, of_small_cores) == hits);
    if (!hits) return false;
    const RayHit seen = detail::to_ray_hit(hit, 0), seen_by_small_cores = detail::to_ray_hit(of_small_cores, 0);
    REQUIRE(hit.tau == of_small_cores.tau);
    REQUIRE(seen.t == seen_by_small_cores.t);
    REQUIRE(seen.u == seen_by_small_cores.u);
    REQUIRE(seen.v == seen_by_small_cores.v);
    REQUIRE(seen.normal == seen_by_small_cores.normal);
    return true;
}

Vec3 to_vec3(const GridPoint& p) {
    return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

/// Exactly at corners and middles of sides more often than not; coordinates are multiples of 1/2.
Vec3 some_target(Random& random, const GridTriangle& triangle) {
    const GridPoint corners[3] = {triangle.a, triangle.b, triangle.c};
    const Vec3 p = to_vec3(corners[random.below(3)]);
    const Vec3 q = to_vec3(corners[random.below(3)]);
    switch (random.below(4)) {
        case 0:
            return p;
        case 1:
            return middle(p, q);
        case 2:
            return {p.x + random.signed_unit(), p.y + random.signed_unit(), p.z + random.signed_unit()};
        default: {
            const float s = random.unit();
            return {p.x + s * (q.x - p.x), p.y + s * (q.y - p.y), p.z + s * (q.z - p.z)};
        }
    }
}

/// In lattice steps. Differences of small multiples of 1/64 are exact, so that many rays go exactly where they aim.
Ray some_ray(Random& random, unsigned bits, const GridTriangle& triangle) {
    const Vec3 target = some_target(random, triangle);
    Ray ray = {.origin = to_vec3(some_grid_point(random, bits)), .direction = {}};
    if (random.below(4) == 0) {
        const float size = std::ldexp(1.0f, static_cast<int>(bits + random.below(12)));
        ray.origin = random.in_cube(size);
    }
    if (random.below(4) == 0) {
        const auto axis = random.below(3);
        ray.direction = {axis == 0 ? 1.0f : 0.0f, axis == 1 ? 1.0f : 0.0f, axis == 2 ? 1.0f : 0.0f};
        if (random.coin()) ray.direction = {-ray.direction.x, -ray.direction.y, -ray.direction.z};
        const Vec3 d = ray.direction;
        ray.origin = {d.x != 0 ? ray.origin.x : target.x, d.y != 0 ? ray.origin.y : target.y,
                      d.z != 0 ? ray.origin.z : target.z};
    } else if (random.below(8) == 0) {
        ray.origin = target;
        ray.direction = random.in_cube(1.0f);
    } else {
        ray.direction = difference(target, ray.origin);
    }
    ray.culling = static_cast<FaceCulling>(random.below(3));
    return ray;
}

bool faces_match(FaceCulling culling, bool front) {
    return culling == FaceCulling::none || (culling == FaceCulling::back) == front;
}

TEST_CASE("kernel: a ray hits a triangle exactly where exact arithmetic does") {
    std::uint64_t decided = 0;
    Random random(1);
    std::uint64_t hits = 0, touches = 0, wide = 0, widest = 0;
    Rational worst_tau = 0, worst_weight = 0;
    const std::uint64_t count = scaled(30'000);
    for (std::uint64_t i = 0; i < count; ++i) {
        const unsigned bits = 1 + random.below(24);
        const GridTriangle triangle = some_triangle(random, bits);
        const Ray world = some_ray(random, bits, triangle);
        LatticeRay ray;
        if (!detail::round_ray(tests::lattice_asset(bits), world, ray)) continue;
        const auto crossing = oracle::cross(tests::exact_line(ray), tests::exact_triangle(triangle));
        const bool expected = crossing && crossing->t.sign() >= 0 && faces_match(world.culling, crossing->front);
        detail::TriangleHit hit{};
        const detail::LatticeTriangle lattice = tests::lattice_triangle(triangle);
        ++decided;
        REQUIRE(both_intersect(ray, lattice, hit) == expected);
        if (!expected) continue;
        ++hits;
        if (crossing->u.sign() == 0 || crossing->v.sign() == 0 || crossing->u + crossing->v == Rational(1)) ++touches;
        const auto relative = detail::relative_to(ray, lattice);
        if (!detail::ray_triangle::edges_are_below<12>(relative))
            ++(detail::ray_triangle::edges_are_below<18>(relative) ? wide : widest);
        worst_tau = std::max(worst_tau, oracle::error_in_ulp(hit.tau, crossing->t));
        const RayHit surface = detail::to_ray_hit(ray, world, hit, 0);
        worst_weight = std::max(
            {worst_weight, oracle::error_in_ulp(surface.u, crossing->u), oracle::error_in_ulp(surface.v, crossing->v)});
    }
    CHECK(worst_tau <= Rational(3));
    CHECK(worst_weight <= Rational(3));
    CHECK(hits > count / 10);
    CHECK(touches > count / 50);
    CHECK(wide > count / 50);
    CHECK(widest > count / 50);
    MESSAGE(count, " rays, ", hits, " hits, ", touches, " of them on a corner or side");
    MESSAGE(decisions_made("ray and triangle", decided));
}

TEST_CASE("kernel: a ray misses a triangle without area") {
    std::uint64_t decided = 0;
    Random random(4);
    for (std::uint64_t i = 0; i < scaled(10'000); ++i) {
        const unsigned bits = 1 + random.below(24);
        const GridTriangle triangle = tests::flat_triangle(random, bits);
        LatticeRay ray;
        if (!detail::round_ray(tests::lattice_asset(bits), some_ray(random, bits, triangle), ray)) continue;
        REQUIRE_FALSE(oracle::cross(tests::exact_line(ray), tests::exact_triangle(triangle)));
        detail::TriangleHit hit{};
        ++decided;
        REQUIRE_FALSE(both_intersect(ray, tests::lattice_triangle(triangle), hit));
    }
    MESSAGE(decisions_made("ray and flat triangle", decided));
}

TEST_CASE("kernel: the window of a ray is closed and exact to the next float") {
    Random random(2);
    std::uint64_t exact_hits = 0;
    const std::uint64_t count = scaled(20'000);
    for (std::uint64_t i = 0; i < count; ++i) {
        const unsigned bits = 1 + random.below(24);
        const GridTriangle triangle = some_triangle(random, bits);
        const Ray world = some_ray(random, bits, triangle);
        const detail::BlobData data = tests::lattice_asset(bits);
        LatticeRay ray;
        if (!detail::round_ray(data, world, ray)) continue;
        const auto crossing = oracle::cross(tests::exact_line(ray), tests::exact_triangle(triangle));
        if (!crossing || crossing->t.sign() < 0 || !faces_match(world.culling, crossing->front)) continue;
        const detail::LatticeTriangle lattice = tests::lattice_triangle(triangle);
        detail::TriangleHit hit{};
        REQUIRE(both_intersect(ray, lattice, hit));
        const float tau = hit.tau;
        if (Rational::of(tau) == crossing->t) ++exact_hits;
        // A few floats around the hit as the ends of the window: exactness is decided, not approximated.
        float bound = tau;
        for (int step = 0; step < 4 && bound > 0.0f; ++step) bound = std::nextafter(bound, 0.0f);
        for (int step = 0; step < 9; ++step, bound = std::nextafter(bound, 1e30f)) {
            LatticeRay windowed = ray;
            detail::TriangleHit found{};
            windowed.tau_min = bound;
            REQUIRE(both_intersect(windowed, lattice, found) == (crossing->t >= Rational::of(bound)));
            windowed = ray;
            windowed.tau_max = bound;
            REQUIRE(both_intersect(windowed, lattice, found) == (crossing->t <= Rational::of(bound)));
        }
    }
    CHECK(exact_hits > count / 100);
}

TEST_CASE("kernel: the normal is the unit normal of the front within 4 ulp") {
    Random random(3);
    for (std::uint64_t i = 0; i < scaled(10'000); ++i) {
        const unsigned bits = 1 + random.below(24);
        const GridTriangle triangle = some_triangle(random, bits);
        const Ray world = some_ray(random, bits, triangle);
        LatticeRay ray;
        if (!detail::round_ray(tests::lattice_asset(bits), world, ray)) continue;
        detail::TriangleHit hit{};
        const detail::LatticeTriangle lattice = tests::lattice_triangle(triangle);
        if (!both_intersect(ray, lattice, hit)) continue;
        const Vec3 normal = detail::to_ray_hit(ray, world, hit, 0).normal;
        const oracle::Point exact = oracle::normal_of(tests::exact_triangle(triangle));
        const Rational squared_length = exact.dot(exact);
        const float given[3] = {normal.x, normal.y, normal.z};
        // |n - m / |m|| <= e  exactly when  (n - e) |m| <= m <= (n + e) |m|; squared to stay rational.
        const Rational allowed = Rational::of(4, -24);                         // 4 ulp of numbers just below 1
        const auto at_most = [&](const Rational& a, const Rational& factor) {  // a <= factor * |m|
            const Rational left = a * oracle::absolute(a);
            const Rational right = factor * oracle::absolute(factor) * squared_length;
            return left <= right;
        };
        for (int k = 0; k < 3; ++k) {
            const Rational n = Rational::of(given[k]);
            REQUIRE(at_most(exact[k], n + allowed));
            REQUIRE(at_most(-exact[k], allowed - n));
        }
    }
}

TEST_CASE("kernel: a ray through a shared side or corner hits at least one neighbour") {
    Random random(4);
    for (std::uint64_t i = 0; i < scaled(20'000); ++i) {
        const unsigned bits = 2 + random.below(23);
        // A closed fan around a corner, seen from above: whatever passes it hits one of its triangles.
        const std::int32_t limit = (1 << bits) - 1;
        const GridPoint apex{random.between(1, limit - 1), random.between(1, limit - 1), random.between(0, limit)};
        const GridPoint rim[4] = {{0, 0, random.between(0, limit)},
                                  {limit, 0, random.between(0, limit)},
                                  {limit, limit, random.between(0, limit)},
                                  {0, limit, random.between(0, limit)}};
        Ray world;
        const Vec3 target = some_target(random, {apex, rim[random.below(4)], apex});
        world.origin = {target.x, target.y, -static_cast<float>(random.between(1, limit))};
        world.direction = {0.0f, 0.0f, 1.0f};
        if (target.x < 0 || target.y < 0 || target.x > static_cast<float>(limit) ||
            target.y > static_cast<float>(limit)) {
            continue;
        }
        LatticeRay ray;
        REQUIRE(detail::round_ray(tests::lattice_asset(bits), world, ray));
        int hits = 0;
        for (unsigned k = 0; k < 4; ++k) {
            detail::TriangleHit hit{};
            const GridTriangle triangle{apex, rim[k], rim[(k + 1) % 4]};
            if (both_intersect(ray, tests::lattice_triangle(triangle), hit)) ++hits;
        }
        REQUIRE(hits >= 1);
    }
}

}  // namespace
}  // namespace espalier::tests::ray_triangle_test
