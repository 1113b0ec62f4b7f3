// Claims about crossings: of the hits around an edge or a vertex, those of a ray that is moved a little, in rationals.
#include "support/testing.hpp"

#include <runtime/kernels/crossing.hpp>

#include "oracle/winding.hpp"
#include "support/exact/as_rationals.hpp"
#include "support/exact/grid_triangles.hpp"
#include "support/queries/winding_points.hpp"

namespace espalier::tests::crossing_test {
namespace {

/// The line with its origin moved by 2^-100 along x, 2^-200 along y and 2^-300 along z: by less than any distance
/// between a line and a corner of the lattice.
oracle::Line moved(oracle::Line line) {
    line.origin[0] += Rational::of(1, -100);
    line.origin[1] += Rational::of(1, -200);
    line.origin[2] += Rational::of(1, -300);
    return line;
}

Vec3 to_vec3(const GridPoint& p) {
    return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

/// A ray from a lattice point through a corner, the middle of a side, or along an axis: it meets them exactly.
Ray ray_at_border(Random& random, unsigned bits, const GridTriangle& triangle) {
    const GridPoint corners[3] = {triangle.a, triangle.b, triangle.c};
    const Vec3 p = to_vec3(corners[random.below(3)]), q = to_vec3(corners[random.below(3)]);
    const Vec3 target = middle(p, q);
    Ray ray = {.origin = to_vec3(some_grid_point(random, bits)), .direction = {}};
    if (random.coin()) {
        ray.direction = difference(target, ray.origin);
        return ray;
    }
    const auto axis = random.below(3);
    const float way = random.coin() ? 1.0f : -1.0f;
    ray.direction = {axis == 0 ? way : 0.0f, axis == 1 ? way : 0.0f, axis == 2 ? way : 0.0f};
    ray.origin = {axis == 0 ? ray.origin.x : target.x, axis == 1 ? ray.origin.y : target.y,
                  axis == 2 ? ray.origin.z : target.z};
    return ray;
}

std::vector<RayHit> crossings_of(const Blob& blob, const Ray& ray) {
    std::vector<RayHit> crossings;
    REQUIRE(for_each_crossing(blob, ray, [&](const RayHit& hit) { crossings.push_back(hit); }) == QueryStatus::ok);
    return crossings;
}

/// Returns how often the ray leaves through fronts and backs, less how often it enters.
int left_less_entered(const std::vector<RayHit>& crossings) {
    int number = 0;
    for (const RayHit& crossing : crossings) number += crossing.side == Side::back ? 1 : -1;
    return number;
}

oracle::WholePoint doubled(const GridPoint& point) { return {2 * point[0], 2 * point[1], 2 * point[2]}; }

TEST_CASE("kernel: a hit is a crossing exactly where the moved ray hits in exact arithmetic") {
    std::uint64_t decided = 0, borders = 0, kept = 0;
    Random random(31);
    const std::uint64_t count = scaled(30'000);
    for (std::uint64_t i = 0; i < count; ++i) {
        const unsigned bits = 1 + random.below(22);
        const GridTriangle triangle = some_triangle(random, bits);
        const Ray world = ray_at_border(random, bits, triangle);
        detail::LatticeRay ray;
        if (!detail::round_ray(lattice_asset(bits), world, ray)) continue;
        const oracle::Line line = exact_line(ray);
        const auto crossing = oracle::cross(line, exact_triangle(triangle));
        if (!crossing || crossing->t.sign() < 0) continue;
        const bool expected = oracle::cross(moved(line), exact_triangle(triangle)).has_value();
        ++decided;
        REQUIRE(detail::is_crossing(ray, lattice_triangle(triangle)) == expected);
        const bool at_border =
            crossing->u.sign() == 0 || crossing->v.sign() == 0 || crossing->u + crossing->v == Rational(1);
        if (!at_border) REQUIRE(expected);
        borders += at_border ? 1u : 0u;
        kept += at_border && expected ? 1u : 0u;
    }
    CHECK(borders > decided / 2);
    CHECK(kept > borders / 4);
    CHECK(kept < borders - borders / 4);
    MESSAGE(decisions_made("ray and crossing", decided), ", ", borders, " at a border, ", kept, " of them kept");
}

TEST_CASE("crossing: the crossings of a ray are those of its hits that the moved ray keeps") {
    const std::uint64_t count = scaled_share(100);
    std::uint64_t hits = 0, dropped = 0;
    ask_each<QueryMaker>(small_test_blobs(), 401, count, [&](const TestBlob& blob, QueryMaker& maker, std::uint64_t) {
        Ray ray = maker.any_ray();
        if (maker.random().below(3) == 0) maker.restrict(ray);
        CAPTURE(describe(ray));
        detail::LatticeRay rounded;
        std::vector<RayHit> expected;
        if (detail::round_ray(detail::data_of(blob.opened.blob), ray, rounded)) {
            const oracle::Line line = moved(exact_line(rounded));
            static_cast<void>(for_each_hit(blob.opened.blob, ray, [&](const RayHit& hit) {
                const GridTriangle& triangle = blob.decoded.triangles[hit.triangle.index];
                ++hits;
                if (oracle::cross(line, exact_triangle(triangle))) expected.push_back(hit);
                else ++dropped;
            }));
        }
        const std::vector<RayHit> crossings = crossings_of(blob.opened.blob, ray);
        REQUIRE(crossings.size() == expected.size());
        for (std::size_t k = 0; k < crossings.size(); ++k) REQUIRE(same_bits(crossings[k], expected[k]));
        const RoundedRay of_region = round_ray(blob.opened.blob.lattice(), ray);
        std::size_t next = 0;
        const QueryStatus status = for_each_crossing(blob.opened.blob, of_region, [&](const RayHit& hit) {
            next += next < expected.size() && same_bits(hit, expected[next]) ? 1 : expected.size() + 1;
        });
        if (status == QueryStatus::ok) REQUIRE(next == expected.size());
    });
    CHECK(dropped > 0);
    CHECK(hits > count);
    MESSAGE(hits, " hits, ", dropped, " of them no crossings");
}

TEST_CASE("crossing: a ray leaves a closed surface as often as the winding number at its origin") {
    const std::uint64_t count = scaled_share(200);
    std::uint64_t asked = 0, ties = 0;
    for (const TestBlob& blob : closed_blobs()) {
        CAPTURE(blob.name);
        // Lattice points and points between two: in doubled coordinates all are whole numbers.
        std::vector<oracle::WholeTriangle> surface;
        for (const GridTriangle& t : blob.decoded.triangles)
            surface.push_back({{doubled(t.a), doubled(t.b), doubled(t.c)}});
        Random random(77);
        for (std::uint64_t i = 0; i < count; ++i) {
            const GridTriangle& t = some_triangle(blob.decoded, random);
            const GridPoint corners[3] = {t.a, t.b, t.c};
            const Vec3 from = awkward_point(blob, random);
            const Lattice lattice = blob.opened.blob.lattice();
            const double step = std::ldexp(1.0, lattice.step_exponent);
            const auto in_world = [&](const GridPoint& p) {
                return Vec3{static_cast<float>(static_cast<double>(lattice.origin.x) + p[0] * step),
                            static_cast<float>(static_cast<double>(lattice.origin.y) + p[1] * step),
                            static_cast<float>(static_cast<double>(lattice.origin.z) + p[2] * step)};
            };
            const Vec3 to = in_world(corners[random.below(3)]);
            Ray ray = {.origin = from, .direction = difference(to, from)};
            detail::LatticeRay rounded;
            const bool may_hit = detail::round_ray(detail::data_of(blob.opened.blob), ray, rounded);
            if (!may_hit || rounded.tau_offset != 0.0f || rounded.fraction_bits == 0) continue;
            oracle::WholePoint point;
            bool is_half = true;
            for (unsigned k = 0; k < 3; ++k) {
                const std::int64_t units = std::int64_t{rounded.origin[k]} * 2;
                is_half = is_half && (units & ((std::int64_t{1} << rounded.fraction_bits) - 1)) == 0;
                point[k] = units >> rounded.fraction_bits;
            }
            if (!is_half || oracle::is_on_surface(surface, point)) continue;
            const std::vector<RayHit> crossings = crossings_of(blob.opened.blob, ray);
            std::size_t all = 0;
            static_cast<void>(for_each_hit(blob.opened.blob, ray, [&](const RayHit&) { ++all; }));
            ties += all != crossings.size() ? 1u : 0u;
            ++asked;
            REQUIRE(left_less_entered(crossings) == static_cast<int>(std::lround(oracle::winding(surface, point))));
        }
    }
    if (asks_enough()) {
        CHECK(asked > 10 * count);
        CHECK(ties > asked / 10);
    }
    MESSAGE(asked, " rays, ", ties, " of them through an edge or a vertex");
}

TEST_CASE("crossing: refusals and stops are those of all hits") {
    const TestBlob& cube = closed_blobs().front();
    const Ray ray = {.origin = {0.0f, 0.0f, -4.0f}, .direction = {0.0f, 0.0f, 1.0f}};
    CHECK(for_each_crossing(Blob(), ray, [](const RayHit&) {}) == QueryStatus::not_open);
    CHECK(for_each_crossing(cube.opened.blob, Ray{}, [](const RayHit&) {}) == QueryStatus::invalid_argument);
    CHECK(for_each_crossing(cube.opened.blob, RoundedRay(), [](const RayHit&) {}) == QueryStatus::invalid_argument);
    int calls = 0;
    const auto stop = [&](const RayHit&) {
        ++calls;
        return Visit::stop;
    };
    CHECK(for_each_crossing(cube.opened.blob, ray, stop) == QueryStatus::stopped);
    CHECK(calls == 1);
    // Through the middle of two faces, where their two triangles meet.
    CHECK(crossings_of(cube.opened.blob, ray).size() == 2);
}

}  // namespace
}  // namespace espalier::tests::crossing_test
