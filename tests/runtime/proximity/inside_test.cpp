// Claims about inside and outside as the header words them; that they equal the loop, inside_loop_test.cpp shows.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <espalier/inside.hpp>
#include <runtime/nearest_world.hpp>
#include <runtime/winding.hpp>

#include "support/base/calls.hpp"
#include "support/base/profiles.hpp"
#include "support/base/same_bits.hpp"
#include "support/blobs/test_blobs.hpp"
#include "support/exact/as_rationals.hpp"
#include "support/meshes/makers.hpp"
#include "support/queries/ray_maker.hpp"
#include "support/queries/winding_points.hpp"

using namespace espalier;
using namespace espalier::tests;
using detail::AxisDirection;
using detail::LatticePoint;
using detail::Winding;
using detail::WindingRay;
using oracle::Rational;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

constexpr AxisDirection all_directions[] = {{0, false}, {0, true}, {1, false}, {1, true}, {2, false}, {2, true}};

bool is_on(const oracle::Triangle& triangle, const oracle::Point& point) {
    if (oracle::normal_of(triangle).dot(point - triangle.a).sign() != 0) return false;
    return oracle::closest_on_triangle(triangle, point).squared_distance.sign() == 0;
}

/// By crossings of a line that meets no side, in whatever direction that is; nothing for a point on the surface.
std::optional<int> exact_winding(const TestBlob& blob, const oracle::Point& point, Random& random) {
    std::vector<oracle::Triangle> triangles;
    for (const GridTriangle& triangle : blob.decoded.triangles) {
        triangles.push_back(exact_triangle(triangle));
        if (is_on(triangles.back(), point)) return std::nullopt;
    }
    for (;;) {
        const oracle::Point direction(Rational(random.between(-1000, 1000)), Rational(random.between(-1000, 1000)),
                                      Rational(random.between(-1000, 1000)));
        int winding = 0;
        const bool clean = std::all_of(triangles.begin(), triangles.end(), [&](const oracle::Triangle& triangle) {
            const auto crossing = oracle::cross({point, direction}, triangle);
            if (!crossing) return oracle::normal_of(triangle).dot(direction).sign() != 0;
            const bool touches_side =
                crossing->u.sign() == 0 || crossing->v.sign() == 0 || crossing->u + crossing->v == Rational(1);
            if (crossing->t.sign() > 0) winding += crossing->front ? -1 : 1;
            return !touches_side;
        });
        if (clean) return winding;
    }
}

}  // namespace

TEST_SUITE("inside") {
    TEST_CASE("inside: contains is true where the exact winding number is not 0 and on the surface") {
        std::uint64_t decided = 0;
        std::uint64_t inside_count = 0;
        std::uint64_t on_surface = 0;
        for (const TestBlob& blob : closed_blobs()) {
            CAPTURE(blob.name);
            Random random(1000);
            for (std::uint64_t i = 0; i < scaled_share(60); ++i) {
                const Vec3 point = random.below(4) == 0 ? random_point(blob, random) : awkward_point(blob, random);
                CAPTURE(describe(Sphere{point, 0.0f}));
                LatticePoint rounded{};
                REQUIRE(detail::round_point(blob.opened.blob.data(), point, infinity, rounded));
                const std::optional<int> expected = exact_winding(blob, exact_center(rounded), random);
                bool inside = false;
                REQUIRE(contains(blob.opened.blob, point, inside) == QueryStatus::ok);
                ++decided;
                REQUIRE(inside == (!expected || *expected != 0));
                std::optional<WindingRay> ray = shortest_way_out(blob.opened.blob, point);
                if (!ray) continue;
                for (const AxisDirection& direction : all_directions) {
                    ray->direction = direction;
                    const Winding winding = detail::winding_number(blob.opened.blob.data(), *ray);
                    REQUIRE(winding.on_surface == !expected);
                    if (expected) REQUIRE(winding.number == *expected);
                }
                if (inside) ++inside_count;
                if (!expected) ++on_surface;
            }
        }
        CHECK(inside_count > closed_blobs().size() * scaled_share(60) / 10);
        CHECK(on_surface > closed_blobs().size() * scaled_share(60) / 10);
        MESSAGE(decisions_made("inside of a closed mesh", decided));
    }
}

TEST_SUITE("inside") {
    TEST_CASE("inside: a cube contains its interior and its surface") {
        const OpenedBlob cube(make_cube(-1.0f, 1.0f));
        const auto is_inside = [&](Vec3 point) {
            bool inside = false;
            REQUIRE(contains(cube.blob, point, inside) == QueryStatus::ok);
            return inside;
        };
        CHECK(is_inside({0.0f, 0.0f, 0.0f}));
        CHECK(is_inside({0.25f, -0.5f, 0.75f}));
        CHECK(is_inside({1.0f, 0.5f, 0.25f}));   // on a face
        CHECK(is_inside({1.0f, -1.0f, 0.25f}));  // on a side
        CHECK(is_inside({1.0f, -1.0f, 1.0f}));   // on a corner
        CHECK_FALSE(is_inside({1.0625f, 0.0f, 0.0f}));
        CHECK_FALSE(is_inside({1e6f, 0.0f, 0.0f}));
        CHECK_FALSE(is_inside({-3e38f, 3e38f, 0.0f}));
    }

    TEST_CASE("inside: cavities are outside and nested and reversed shells are inside") {
        const auto is_inside = [](const Mesh& mesh, Vec3 point) {
            const OpenedBlob opened(mesh);
            bool inside = false;
            REQUIRE(contains(opened.blob, point, inside) == QueryStatus::ok);
            return inside;
        };
        const Mesh outer = make_cube(-4.0f, 4.0f);
        const Mesh inner = make_cube(-2.0f, 2.0f);
        const Mesh hollow = joined(outer, turned_inside_out(inner));
        CHECK_FALSE(is_inside(hollow, {0.0f, 0.0f, 0.0f}));
        CHECK(is_inside(hollow, {3.0f, 0.0f, 0.0f}));
        CHECK(is_inside(hollow, {2.0f, 0.0f, 0.0f}));  // the cavity's wall
        CHECK(is_inside(joined(outer, inner), {0.0f, 0.0f, 0.0f}));
        CHECK(is_inside(joined(make_cube(-1.0f, 1.0f), make_cube(0.0f, 2.0f)), {0.5f, 0.5f, 0.5f}));
        CHECK(is_inside(turned_inside_out(outer), {0.0f, 0.0f, 0.0f}));
        CHECK_FALSE(is_inside(turned_inside_out(outer), {0.0f, 0.0f, 5.0f}));
    }

    TEST_CASE("inside: the signed distance is that of the closest point and negative inside") {
        for (const TestBlob& blob : closed_blobs()) {
            CAPTURE(blob.name);
            QueryMaker maker(blob.decoded, 1200);
            for (std::uint64_t i = 0; i < scaled_share(300); ++i) {
                Sphere sphere = maker.sphere();
                sphere.radius = std::fabs(sphere.radius);  // nudged from 0 it may be below
                const Vec3 point = maker.random().coin() ? random_point(blob, maker.random()) : sphere.center;
                CAPTURE(describe(Sphere{point, sphere.radius}));
                bool inside = false;
                REQUIRE(contains(blob.opened.blob, point, inside) == QueryStatus::ok);
                Nearest expected;
                Nearest nearest;
                REQUIRE(signed_distance(blob.opened.blob, point, sphere.radius, nearest) == QueryStatus::ok);
                if (closest_point(blob.opened.blob, point, sphere.radius, expected)) {
                    REQUIRE((nearest.distance < 0.0f) == (inside && expected.distance != 0.0f));
                    nearest.distance = std::fabs(nearest.distance);
                    REQUIRE(same_bits(nearest, expected));
                } else {
                    REQUIRE(nearest.triangle == no_triangle);
                    REQUIRE(std::fabs(nearest.distance) == sphere.radius);
                    REQUIRE(std::signbit(nearest.distance) == inside);
                }
            }
        }
    }

    TEST_CASE("inside: open surfaces and invalid points are refused") {
        const OpenedBlob cube(make_cube(-1.0f, 1.0f));
        const OpenedBlob plane(make_plane_grid(2));
        bool inside = true;
        const Nearest before{{1.0f, 2.0f, 3.0f}, 4.0f, 0.5f, 0.25f, Triangle{7}, Feature::vertex_b};
        Nearest nearest = before;
        const Vec3 center{0.0f, 0.0f, 0.0f};
        CHECK(contains(plane.blob, center, inside) == QueryStatus::not_closed);
        CHECK(contains(Blob(), center, inside) == QueryStatus::not_closed);
        CHECK(contains(cube.blob, {0.0f, not_a_number, 0.0f}, inside) == QueryStatus::invalid_argument);
        CHECK(contains(cube.blob, {0.0f, 0.0f, -infinity}, inside) == QueryStatus::invalid_argument);
        CHECK(signed_distance(plane.blob, center, infinity, nearest) == QueryStatus::not_closed);
        CHECK(signed_distance(Blob(), center, infinity, nearest) == QueryStatus::not_closed);
        CHECK(signed_distance(cube.blob, {not_a_number, 0.0f, 0.0f}, infinity, nearest) ==
              QueryStatus::invalid_argument);
        CHECK(signed_distance(cube.blob, center, not_a_number, nearest) == QueryStatus::invalid_argument);
        CHECK(signed_distance(cube.blob, center, -1.0f, nearest) == QueryStatus::invalid_argument);
        CHECK(signed_distance(cube.blob, {3e38f, 0.0f, 0.0f}, infinity, nearest) == QueryStatus::out_of_range);
        CHECK(inside);
        CHECK(same_bits(nearest, before));
        CHECK(signed_distance(cube.blob, center, 0.5f, nearest) == QueryStatus::ok);
        CHECK(nearest.triangle == no_triangle);
        CHECK(nearest.distance == -0.5f);
        CHECK(signed_distance(cube.blob, center, infinity, nearest) == QueryStatus::ok);
        CHECK(nearest.distance == -1.0f);
    }

    TEST_CASE("inside: a blob with copies is refused") {
        BakeOptions options = with_profile(format::Profile::fast);
        options.builder = Builder::spatial_splits;
        options.duplicates = 1.0;
        Mesh mesh;
        Random random(1300);
        for (std::uint32_t i = 0; i < 200; ++i) {  // tetrahedra of all sizes, which the builder splits
            const Vec3 center = random.in_cube(1.0f);
            const float reach = std::ldexp(1.0f, -static_cast<int>(random.below(9)));
            for (int k = 0; k < 4; ++k) {
                const Vec3 off = random.in_cube(reach);
                mesh.positions.push_back({center.x + off.x, center.y + off.y, center.z + off.z});
            }
            const std::uint32_t a = 4 * i;
            mesh.triangles.insert(mesh.triangles.end(),
                                  {{a, a + 1, a + 2}, {a, a + 2, a + 3}, {a, a + 3, a + 1}, {a + 3, a + 2, a + 1}});
        }
        const OpenedBlob opened(mesh, options);
        REQUIRE(opened.blob.closed());
        REQUIRE(opened.blob.copy_count() > 0);
        bool inside = false;
        Nearest nearest;
        CHECK(contains(opened.blob, {0.0f, 0.0f, 0.0f}, inside) == QueryStatus::has_copies);
        CHECK(signed_distance(opened.blob, {0.0f, 0.0f, 0.0f}, 1.0f, nearest) == QueryStatus::has_copies);
    }
}
