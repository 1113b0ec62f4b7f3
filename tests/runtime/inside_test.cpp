// Claims about inside and outside as the header words them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <espalier/inside.hpp>
#include <runtime/nearest_world.hpp>
#include <runtime/winding.hpp>

#include "../support/mesh_files.hpp"
#include "../support/mesh_makers.hpp"
#include "../support/profiles.hpp"
#include "../support/query_maker.hpp"
#include "../support/same_bits.hpp"
#include "../support/test_blobs.hpp"
#include "../support/triangle_loop.hpp"
#include "exact_query.hpp"

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

Mesh joined(Mesh mesh, const Mesh& other) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
    for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
    mesh.name += " and " + other.name;
    return mesh;
}

Mesh turned_inside_out(Mesh mesh) {
    for (TriangleVertices& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    mesh.name += " inside out";
    return mesh;
}

/// Closed blobs: of one shell and of several, nested, overlapping, inside out, touching in many lattice points.
const std::vector<TestBlob>& closed_blobs() {
    static const std::vector<TestBlob> blobs = [] {
        std::vector<TestBlob> made;
        const auto add = [&](const Mesh& mesh, unsigned bits) {
            for_each_profile([&](format::Profile profile) {
                BakeOptions options = with_profile(profile);
                options.bits = bits;
                OpenedBlob opened(mesh, options);
                REQUIRE(opened.blob.closed());
                DecodedBlob decoded = decode(opened.bytes);
                made.push_back({mesh.name + ", profile " + name_of(profile), std::move(opened), std::move(decoded)});
            });
        };
        const auto sphere = [](double radius, Vec3 center) { return make_icosphere(1, radius, center); };
        add(make_cube(-1.0f, 1.0f), 16);
        add(make_cube(0.0f, 1.0f), 1);
        add(make_torus(16, 8, 2.0, 0.7), 5);
        add(make_torus(24, 12, 2.0, 0.7), 24);
        add(make_uv_sphere(8, 12, 1.0, {0.0f, 0.0f, 0.0f}), 12);
        add(make_icosphere(2, 2.0, {148376.0f, 1234.0f, -223423.0f}), 16);
        add(turned_inside_out(sphere(1.0, {0.0f, 0.0f, 0.0f})), 10);
        add(joined(make_cube(-2.0f, 2.0f), turned_inside_out(make_cube(-1.0f, 1.0f))), 8);
        add(joined(joined(make_cube(-4.0f, 4.0f), turned_inside_out(sphere(3.0, {0.0f, 0.0f, 0.0f}))),
                   sphere(1.5, {0.5f, 0.25f, 0.0f})),
            16);
        add(joined(sphere(1.0, {0.0f, 0.0f, 0.0f}), sphere(1.0, {0.75f, 0.5f, 0.0f})), 16);
        add(joined(make_cube(0.0f, 2.0f), turned_inside_out(make_cube(1.0f, 3.0f))), 4);
        return made;
    }();
    return blobs;
}

/// Points whose ways out meet corners, sides and faces: coordinates of vertices and of the middles of sides, together
/// and mixed.
Vec3 awkward_point(const TestBlob& blob, Random& random) {
    const auto some_vertex = [&] {
        const GridTriangle& t =
            blob.decoded.triangles[random.below(static_cast<std::uint32_t>(blob.decoded.triangles.size()))];
        const std::uint32_t corner = random.below(3);
        return corner == 0 ? t.a : corner == 1 ? t.b : t.c;
    };
    const GridTriangle& t =
        blob.decoded.triangles[random.below(static_cast<std::uint32_t>(blob.decoded.triangles.size()))];
    const std::uint32_t kind = random.below(5);
    double at[3];
    for (unsigned k = 0; k < 3; ++k) {
        switch (kind) {
            case 0:
                at[k] = t.a[k];
                break;
            case 1:
                at[k] = 0.5 * (t.a[k] + t.b[k]);
                break;
            case 2:
                at[k] = 0.25 * t.a[k] + 0.25 * t.b[k] + 0.5 * t.c[k];
                break;
            default:
                at[k] = some_vertex()[k];
        }
    }
    if (kind < 3 && random.below(4) != 0) {
        const std::uint32_t axis = random.below(3);
        at[axis] = random.coin() ? some_vertex()[axis] : static_cast<double>(random.unit()) * blob.decoded.extent[axis];
    }
    const double step = std::ldexp(1.0, blob.decoded.step_exponent);
    const auto world = [&](unsigned k) {
        return static_cast<float>(static_cast<double>(blob.decoded.origin[k]) + at[k] * step);
    };
    return {world(0), world(1), world(2)};
}

Vec3 random_point(const TestBlob& blob, Random& random) {
    const Vec3 low = blob.opened.blob.bounds_min();
    const Vec3 high = blob.opened.blob.bounds_max();
    const auto between = [&](float from, float to) { return from + (to - from) * (random.unit() * 1.1f - 0.05f); };
    const float x = between(low.x, high.x);
    const float y = between(low.y, high.y);
    return {x, y, between(low.z, high.z)};
}

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

/// Where the asset's box does not hold the point nothing winds around it.
std::optional<WindingRay> way_out(const Blob& blob, Vec3 point) {
    LatticePoint rounded;
    WindingRay ray;
    if (!detail::round_point(blob.data(), point, infinity, rounded)) return std::nullopt;
    if (!detail::shortest_way_out(blob.data(), rounded, ray)) return std::nullopt;
    return ray;
}

/// Along one of the ways out.
void check_winding(const TestBlob& blob, const TriangleLoop& loop, Vec3 point, Random& random) {
    CAPTURE(describe(Sphere{point, 0.0f}));
    std::optional<WindingRay> ray = way_out(blob.opened.blob, point);
    if (!ray) return;
    ray->direction = all_directions[random.below(6)];
    const Winding expected = loop.winding(*ray);
    const Winding winding = detail::winding_number(blob.opened.blob.data(), *ray);
    REQUIRE(winding.on_surface == expected.on_surface);
    if (!winding.on_surface) REQUIRE(winding.number == expected.number);
    bool inside = false;
    REQUIRE(contains(blob.opened.blob, point, inside) == QueryStatus::ok);
    REQUIRE(inside == expected.is_inside());
}

/// Says whether the point is inside.
bool check_signed_distance(const TestBlob& blob, const TriangleLoop& loop, Vec3 point) {
    CAPTURE(describe(Sphere{point, 0.0f}));
    const Blob& opened = blob.opened.blob;
    LatticePoint rounded;
    REQUIRE(detail::round_point(opened.data(), point, infinity, rounded));
    const detail::FoundNearest found = loop.by_distance(rounded, 1).at(0);
    const std::optional<WindingRay> ray = way_out(opened, point);
    const bool inside = ray && loop.winding(*ray).is_inside();
    // The runtime's own translation: what is found, not the translation, is compared here.
    Nearest expected = detail::to_nearest(opened.data(), found);
    expected.distance =
        detail::to_world_distance(opened.data(), found.distance.squared, rounded.distance_offset, infinity);
    if (inside && expected.distance != 0.0f) expected.distance = -expected.distance;
    Nearest nearest;
    REQUIRE(signed_distance(opened, point, infinity, nearest) == QueryStatus::ok);
    REQUIRE(same_bits(nearest, expected));
    return inside;
}

}  // namespace

TEST_SUITE("queries against the oracle") {
    TEST_CASE("inside is where the exact winding number is not zero, or on the surface, whatever the way out") {
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
                REQUIRE(inside == (!expected || *expected != 0));
                std::optional<WindingRay> ray = way_out(blob.opened.blob, point);
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
    }
}

TEST_SUITE("traversal against the loop") {
    TEST_CASE("winding numbers: every way out equals the loop") {
        for (const TestBlob& blob : closed_blobs()) {
            CAPTURE(blob.name);
            const TriangleLoop loop(blob.decoded);
            Random random(1100);
            for (std::uint64_t i = 0; i < scaled_share(2'000); ++i)
                check_winding(blob, loop, random.coin() ? random_point(blob, random) : awkward_point(blob, random),
                              random);
        }
    }
    TEST_CASE("real meshes: winding numbers and signed distances of closed ones equal the loop") {
        const auto files = mesh_files();
        if (files.empty()) {
            MESSAGE("SKIPPED: no .obj or .ply file in the folder ESPALIER_MESHES");
            return;
        }
        for (const auto& file : files) {
            const Mesh mesh = read_mesh(file);
            CAPTURE(mesh.name);
            if (mesh.triangles.size() > 200'000) continue;  // baking it takes longer than asking it
            for_each_profile([&](format::Profile profile) {
                OpenedBlob opened(mesh, with_profile(profile));
                if (!opened.blob.closed()) return;
                DecodedBlob decoded = decode(opened.bytes);
                const TestBlob blob = {mesh.name, std::move(opened), std::move(decoded)};
                const TriangleLoop loop(blob.decoded);
                Random random(1150 + static_cast<std::uint64_t>(profile));
                // Times a scale of 1,000 these are at least the counts that a release must show.
                const std::uint64_t count = scaled_share(112);
                std::uint64_t inside = 0;
                for (std::uint64_t i = 0; i < count; ++i) {
                    const Vec3 point = i % 10 == 9 ? awkward_point(blob, random) : random_point(blob, random);
                    check_winding(blob, loop, point, random);
                    inside += check_signed_distance(blob, loop, point) ? 1u : 0u;
                }
                MESSAGE(mesh.name, ", profile ", name_of(profile), ": ", count - count / 10, " random and ", count / 10,
                        " awkward points equal the loop; ", inside, " inside");
            });
        }
    }
}

TEST_SUITE("inside") {
    TEST_CASE("a cube has an inside, and its surface belongs to it") {
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

    TEST_CASE(
        "cavities are outside, what is in several shells is inside, and so is the inside of a surface inside out") {
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

    TEST_CASE("the signed distance is that of the closest point, negative inside") {
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

    TEST_CASE("what has no inside, and what is no point, is told") {
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

    TEST_CASE("a blob with copies does not say what is inside") {
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
