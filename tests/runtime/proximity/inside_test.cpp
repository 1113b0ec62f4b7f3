// Claims about inside and outside as the header words them; that they equal the loop, inside_loop_test.cpp shows.
#include "support/testing.hpp"

#include <runtime/answers/nearest_to_local.hpp>
#include <runtime/proximity/winding.hpp>

#include "support/blobs/deformed_mesh.hpp"
#include "support/exact/as_rationals.hpp"
#include "support/loops/triangle_loop.hpp"
#include "support/meshes/motions.hpp"
#include "support/queries/winding_points.hpp"

namespace espalier::tests::inside_test {
namespace {

using detail::AxisDirection;
using detail::RoundedPoint;
using detail::Winding;
using detail::WindingRay;

constexpr AxisDirection all_directions[] = {{0, false}, {0, true}, {1, false}, {1, true}, {2, false}, {2, true}};

bool is_on(const oracle::Triangle& triangle, const oracle::Point& point) {
    if (oracle::normal_of(triangle) == oracle::Point(0, 0, 0)) {
        const std::array<oracle::Point, 1> center = {point};
        const std::array<oracle::Point, 3> corners = {triangle.a, triangle.b, triangle.c};
        return oracle::squared_distance(center, corners).sign() == 0;
    }
    if (oracle::normal_of(triangle).dot(point - triangle.a).sign() != 0) return false;
    return oracle::closest_on_triangle(triangle, point).squared_distance.sign() == 0;
}

/// By crossings of a line that meets no side, in whatever direction that is; nothing for a point on the surface.
std::optional<int> exact_winding(const DecodedBlob& blob, const oracle::Point& point, Random& random) {
    std::vector<oracle::Triangle> triangles;
    for (const GridTriangle& grid : blob.triangles) {
        const oracle::Triangle triangle = exact_triangle(grid);
        if (is_on(triangle, point)) return std::nullopt;
        // A triangle without area has no side from which to leave.
        if (oracle::normal_of(triangle) != oracle::Point(0, 0, 0)) triangles.push_back(triangle);
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

TEST_CASE("inside: contains is true where the exact winding number is not 0 and on the surface") {
    std::uint64_t decided = 0, inside_count = 0, on_surface = 0;
    const std::uint64_t count = std::max<std::uint64_t>(scaled_share(60), 10);
    for (const TestBlob& blob : closed_blobs()) {
        CAPTURE(blob.name);
        Random random(1000);
        for (std::uint64_t i = 0; i < count; ++i) {
            const Vec3 point = random.below(4) == 0 ? random_point(blob, random) : awkward_point(blob, random);
            CAPTURE(describe(Sphere{point, 0.0f}));
            RoundedPoint rounded{};
            REQUIRE(detail::round_point(detail::data_of(blob.opened.blob), point, infinity, rounded) ==
                    QueryStatus::ok);
            const std::optional<int> expected = exact_winding(blob.decoded, exact_center(rounded), random);
            const YesNo answer = contains(blob.opened.blob, point);
            REQUIRE(!is_refused(answer.status()));
            const bool inside = answer.yes();
            ++decided;
            REQUIRE(inside == (!expected || *expected != 0));
            std::optional<WindingRay> ray = shortest_way_out(blob.opened.blob, point);
            if (!ray) continue;
            for (const AxisDirection& direction : all_directions) {
                ray->direction = direction;
                const Winding winding = detail::winding_number(detail::data_of(blob.opened.blob), *ray);
                REQUIRE(winding.on_surface == !expected);
                if (expected) REQUIRE(winding.number == *expected);
            }
            if (inside) ++inside_count;
            if (!expected) ++on_surface;
        }
    }
    CHECK(inside_count > closed_blobs().size() * count / 10);
    CHECK(on_surface > closed_blobs().size() * count / 10);
    MESSAGE(decisions_made("inside of a closed mesh", decided));
}

TEST_CASE("deformation: contains is true where the exact winding number of the pose is not 0 and on the surface") {
    std::uint64_t decided = 0, inside_count = 0, on_surface = 0;
    for (const unsigned bits : {3u, 5u, 16u}) {  // on coarse lattices many triangles are flat
        DeformedMesh moving(make_icosphere(1, 1.0, {0.0f, 0.0f, 0.0f}), bits);
        Random random(1500 + bits);
        for (const Motion motion : every_motion) {
            moving.move_to(posed(moving.mesh, motion, motion == Motion::collapse ? 0.95 : 1.0));
            const Blob& blob = moving.deformable.blob();
            const DecodedBlob decoded = moving.decoded();
            for (std::uint64_t i = 0; i < scaled(40); ++i) {
                Vec3 point = random.in_box(blob.bounds());
                if (i % 4 == 0) point = triangle_at(blob, TriangleId{random.below(blob.triangle_count())})->a;
                RoundedPoint rounded{};
                REQUIRE(detail::round_point(detail::data_of(blob), point, infinity, rounded) == QueryStatus::ok);
                const std::optional<int> expected = exact_winding(decoded, exact_center(rounded), random);
                const YesNo answer = contains(blob, point);
                REQUIRE(!is_refused(answer.status()));
                ++decided;
                REQUIRE(answer.yes() == (!expected || *expected != 0));
                (expected ? inside_count : on_surface) += answer.yes() ? 1u : 0u;
            }
        }
    }
    CHECK(inside_count > decided / 20);
    CHECK(on_surface > decided / 20);
}

TEST_CASE("inside: a cube contains its interior and its surface") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    const auto is_inside = [&](Vec3 point) {
        const YesNo inside = contains(cube.blob, point);
        REQUIRE(inside.yes() != inside.no());
        return inside.yes();
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
        const YesNo inside = contains(opened.blob, point);
        REQUIRE(inside.yes() != inside.no());
        return inside.yes();
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
    ask_each<QueryMaker>(
        closed_blobs(), 1200, scaled_share(300), [&](const TestBlob& blob, QueryMaker& maker, std::uint64_t) {
            Sphere sphere = maker.sphere();
            sphere.radius = std::fabs(sphere.radius);  // nudged from 0 it may be below
            const Vec3 point = maker.random().coin() ? random_point(blob, maker.random()) : sphere.center;
            CAPTURE(describe(Sphere{point, sphere.radius}));
            const bool inside = contains(blob.opened.blob, point).yes();
            const ClosestPoint expected = closest_point(blob.opened.blob, point, sphere.radius);
            ClosestPoint nearest = signed_distance(blob.opened.blob, point, sphere.radius);
            if (expected) {
                REQUIRE((nearest.distance < 0.0f) == (inside && expected.distance != 0.0f));
                nearest.distance = std::fabs(nearest.distance);
                REQUIRE(same_bits(nearest, expected));
            } else {
                REQUIRE(nearest.status == QueryStatus::not_found);
                REQUIRE(nearest.triangle == no_triangle);
                REQUIRE(std::fabs(nearest.distance) == sphere.radius);
                REQUIRE(std::signbit(nearest.distance) == inside);
            }
        });
}

TEST_CASE("inside: open surfaces and invalid points are refused") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    const OpenedBlob plane(make_plane_grid(2));
    const Vec3 center{0.0f, 0.0f, 0.0f};
    const auto refused = [](YesNo inside, QueryStatus status) {
        CHECK(inside.status() == status);
        CHECK_FALSE(inside.yes());
        CHECK_FALSE(inside.no());
    };
    refused(contains(plane.blob, center), QueryStatus::not_closed);
    refused(contains(Blob(), center), QueryStatus::not_open);
    refused(contains(cube.blob, {0.0f, not_a_number, 0.0f}), QueryStatus::invalid_argument);
    refused(contains(cube.blob, {0.0f, 0.0f, -infinity}), QueryStatus::invalid_argument);
    const auto refused_distance = [](const ClosestPoint& nearest, QueryStatus status) {
        ClosestPoint expected;
        expected.status = status;
        CHECK(same_bits(nearest, expected));
    };
    refused_distance(signed_distance(plane.blob, center), QueryStatus::not_closed);
    refused_distance(signed_distance(Blob(), center), QueryStatus::not_open);
    refused_distance(signed_distance(cube.blob, {not_a_number, 0.0f, 0.0f}), QueryStatus::invalid_argument);
    refused_distance(signed_distance(cube.blob, center, not_a_number), QueryStatus::invalid_argument);
    refused_distance(signed_distance(cube.blob, center, -1.0f), QueryStatus::invalid_argument);
    refused_distance(signed_distance(cube.blob, {3e38f, 0.0f, 0.0f}), QueryStatus::out_of_range);
    const ClosestPoint miss = signed_distance(cube.blob, center, 0.5f);
    CHECK_FALSE(miss);
    CHECK(miss.status == QueryStatus::not_found);
    CHECK(miss.triangle == no_triangle);
    CHECK(miss.distance == -0.5f);
    CHECK(signed_distance(cube.blob, center).status == QueryStatus::ok);
    CHECK(signed_distance(cube.blob, center).distance == -1.0f);
}

TEST_CASE("inside: a blob with duplicate references counts each triangle once") {
    Mesh mesh;
    Random random(1300);
    for (std::uint32_t i = 0; i < 200; ++i) {  // tetrahedra of all sizes, which the builder splits
        const Vec3 center = random.in_cube(1.0f);
        const float reach = std::ldexp(1.0f, -static_cast<int>(random.below(9)));
        for (int k = 0; k < 4; ++k) {
            mesh.positions.push_back(sum(center, random.in_cube(reach)));
        }
        const std::uint32_t a = 4 * i;
        mesh.triangles.insert(mesh.triangles.end(),
                              {{a, a + 1, a + 2}, {a, a + 2, a + 3}, {a, a + 3, a + 1}, {a + 3, a + 2, a + 1}});
    }
    for (int i = 0; i < 80; ++i) {  // shells, so that a way out crosses many triangles
        const float half = 0.5f + 0.005f * static_cast<float>(i);
        mesh = joined(mesh, make_cube(-half, half));
    }
    const OpenedBlob opened(mesh, with_copies());
    REQUIRE(opened.blob.is_closed());
    REQUIRE(opened.blob.duplicate_reference_count() > 0);
    const DecodedBlob decoded = decode(opened.bytes);
    const TriangleLoop loop(decoded);
    std::uint64_t inside_count = 0, most_crossings = 0;
    for (std::uint64_t i = 0; i < scaled(1'000); ++i) {
        Vec3 point = random.in_cube(1.0f);
        if (i % 4 == 0) point = mesh.positions[random.below(static_cast<std::uint32_t>(mesh.positions.size()))];
        CAPTURE(describe(Sphere{point, 0.0f}));
        const YesNo inside = contains(opened.blob, point);
        std::optional<WindingRay> ray = shortest_way_out(opened.blob, point);
        if (!ray) {
            REQUIRE(inside.no());
            continue;
        }
        for (const AxisDirection& direction : all_directions) {
            ray->direction = direction;
            const Winding expected = loop.winding(*ray);
            const Winding winding = detail::winding_number(detail::data_of(opened.blob), *ray);
            REQUIRE(winding.on_surface == expected.on_surface);
            if (!winding.on_surface) REQUIRE(winding.number == expected.number);
            REQUIRE(inside == YesNo::of(expected.is_inside()));
            std::uint64_t crossings = 0;
            for (std::size_t k = 0; k < decoded.triangles.size(); ++k) {
                const GridTriangle& t = decoded.triangles[k];
                const detail::LatticeTriangle triangle = {
                    {{t.a[0], t.a[1], t.a[2]}, {t.b[0], t.b[1], t.b[2]}, {t.c[0], t.c[1], t.c[2]}}};
                if (decoded.owners[k] == k && detail::crossing(*ray, triangle) != 0) ++crossings;
            }
            most_crossings = std::max(most_crossings, crossings);
        }
        inside_count += inside.yes() ? 1u : 0u;
        const ClosestPoint nearest = signed_distance(opened.blob, point);
        REQUIRE(nearest);
        REQUIRE((nearest.distance < 0.0f) == (inside.yes() && nearest.distance != 0.0f));
    }
    CHECK(inside_count > (asks_enough() ? 100 : 0));
    CHECK(most_crossings > 64);  // several times as many as are kept at once
}

}  // namespace
}  // namespace espalier::tests::inside_test
