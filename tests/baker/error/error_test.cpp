// Claims about max_error, measured with a distance of the test's own.
#include "support/testing.hpp"

#include <baker/base/float_rounding.hpp>

#include "baker/baking_support.hpp"

namespace espalier::tests::error_test {
namespace {

using reference::Point;
using reference::to_point;

/// Distance to a triangle by bisection of its barycentric square: slow, plain, and unlike the baker's.
double distance_to(const Point& point, const reference::PointTriangle& triangle) {
    const Point e = triangle[1] - triangle[0];
    const Point f = triangle[2] - triangle[0];
    // For a fixed v the best u is that of a clamped segment; in v the rest is convex.
    const auto best_for = [&](double v) {
        const Point from = triangle[0] + v * f;
        const double u = std::clamp(dot(point - from, e) / dot(e, e), 0.0, 1.0 - v);
        return length(point - (from + u * e));
    };
    double low = 0.0;
    double high = 1.0;
    for (int i = 0; i < 60; ++i) {
        const double a = low + (high - low) / 3;
        const double b = high - (high - low) / 3;
        (best_for(a) < best_for(b) ? high : low) = best_for(a) < best_for(b) ? b : a;
    }
    return best_for((low + high) / 2);
}

Point random_point_of(const Mesh& mesh, const TriangleVertices& triangle, Random& random) {
    double u = double(random.unit());
    double v = double(random.unit());
    if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
    }
    if (random.below(4) == 0) u = 0.0;
    const auto corner = [&](std::size_t i) { return to_point(mesh.positions[triangle[i]]); };
    return (1 - u - v) * corner(0) + u * corner(1) + v * corner(2);
}

/// The largest distance of sampled source points to the baked surface.
double sampled_error(const Mesh& mesh, const Bytes& baked, unsigned samples_per_triangle) {
    const std::vector<reference::PointTriangle> triangles = reference::baked_surface(baked);
    Random random(11);
    double largest = 0.0;
    for (const std::size_t number : sampled(mesh.triangles.size(), 24)) {
        const TriangleVertices& triangle = mesh.triangles[number];
        for (unsigned i = 0; i < samples_per_triangle; ++i) {
            const Point point = random_point_of(mesh, triangle, random);
            double nearest = 1e300;
            for (const auto& other : triangles) nearest = std::min(nearest, distance_to(point, other));
            largest = std::max(largest, nearest);
        }
    }
    return largest;
}

TEST_CASE("error: no point of the source is farther from the baked surface than max_error") {
    for (const Mesh& mesh : {make_icosphere(2, 1.0, {3, 0, 0}), make_soup(40, 9), make_needle_fan(40),
                             make_slivers(40, 3), make_terrain(7, 1)}) {
        for (const unsigned bits : {2u, 3u, 4u, 6u, 9u}) {
            CAPTURE(mesh.name);
            CAPTURE(bits);
            const auto result = must_bake_mesh(mesh, with_bits(bits));
            if (result.report.tree.triangles == 0) continue;
            const double sampled = sampled_error(mesh, result.bytes, 6);
            CHECK(sampled <= result.report.lattice.max_error * (1 + 1e-9));
        }
    }
}

TEST_CASE("error: without dropped triangles max_error is the largest move of a vertex rounded up") {
    for (unsigned seed = 0; seed < 40; ++seed) {
        const Mesh mesh = make_terrain(6, seed);
        BakeOptions options = with_bits(10 + seed % 5);
        options.profile = Profile::fast;  // which keeps the order of corners
        options.original_ids = true;
        const auto result = must_bake_mesh(mesh, options);
        REQUIRE(result.report.tree.triangles == mesh.triangles.size());
        const DecodedBlob decoded = decode(result.bytes);
        double largest = 0.0;
        for (std::size_t i = 0; i < decoded.triangles.size(); ++i) {
            const auto corners = reference::world_corners(decoded, decoded.triangles[i]);
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const Vec3& source = mesh.positions[mesh.triangles[decoded.original_ids[i]][corner]];
                largest = std::max(largest, length(corners[corner] - to_point(source)));
            }
        }
        CHECK(result.report.lattice.max_error >= largest);
        CHECK(result.report.lattice.max_error <= largest * (1 + 1e-6));
    }
}

TEST_CASE("error: max_error is rounded up to float32 and never subnormal") {
    using baker::round_up_to_float;
    CHECK(round_up_to_float(0.0) == 0.0f);
    CHECK(round_up_to_float(1.0) == 1.0f);
    CHECK(round_up_to_float(1.0 + 0x1p-50) == 1.0f + 0x1p-23f);
    CHECK(round_up_to_float(1.0 + 0x1p-23 - 0x1p-50) == 1.0f + 0x1p-23f);
    CHECK(round_up_to_float(1e-300) == std::numeric_limits<float>::min());
    CHECK(round_up_to_float(0x1p-140) == std::numeric_limits<float>::min());
    CHECK(round_up_to_float(double(std::numeric_limits<float>::min())) == std::numeric_limits<float>::min());
    CHECK(round_up_to_float(0x1.fffffep127) == std::numeric_limits<float>::max());
    CHECK(round_up_to_float(0x1.ffffff8p127) == std::numeric_limits<float>::infinity());
}

TEST_CASE("error: a mesh on the lattice has none") {
    const auto result = must_bake_mesh(make_cube(-3.0f, 5.0f));
    CHECK(result.report.lattice.max_error == 0.0);
}

TEST_CASE("error: a speck that vanishes far from the rest counts with its distance") {
    Mesh mesh = make_cube(0.0f, 100.0f);
    append(mesh, make_cube(349.999f, 350.0f));
    const auto result = must_bake_mesh(mesh, with_bits(8));
    CHECK(result.report.findings.collapsed.count == 12);
    const double distance = 250.0 * std::sqrt(3.0);
    CHECK(result.report.lattice.max_error >= distance);
    CHECK(result.report.lattice.max_error <= distance * 1.02);
    // A tolerance keeps the speck instead.
    const auto kept = must_bake_mesh(mesh, with_tolerance(1.0));
    CHECK(kept.report.tree.triangles == 24);
}

TEST_CASE("error: a triangle that collapses across empty space counts with its farthest point") {
    // Between two cubes, a sliver whose middle is 450 away from both.
    Mesh mesh = make_cube(0.0f, 100.0f);
    Mesh other = make_cube(0.0f, 100.0f);
    for (Vec3& point : other.positions) point.x += 1000.0f;
    append(mesh, other);
    append_triangle(mesh, {100, 50, 50}, {1000, 50, 50}, {500, 50.01f, 50});
    const auto result = must_bake_mesh(mesh, with_bits(8));
    CHECK(result.report.findings.collapsed.count == 1);
    CHECK(result.report.lattice.max_error >= 450.0);
    CHECK(result.report.lattice.max_error <= 450.0 * 1.02 + 8.0);
}

TEST_CASE("error: triangles that collapse onto kept edges and vertices add none") {
    // A fine fan along the cube's edge, so thin that it becomes that edge.
    Mesh mesh = make_cube(0.0f, 128.0f);
    append_triangle(mesh, {0, 0, 0}, {128, 0, 0}, {64, 0.001f, 0.001f});
    append_triangle(mesh, {0, 0, 0}, {0, 0, 0}, {128, 0, 0});
    const auto result = must_bake_mesh(mesh, with_bits(8));
    CHECK(result.report.findings.collapsed.count == 1);
    CHECK(result.report.findings.zero_area.count == 1);
    CHECK(result.report.lattice.max_error <= 0.0015);
    CHECK(result.report.lattice.max_error >= 0.001);
}

TEST_CASE("error: a source triangle without area counts with its distance and the tolerance names it") {
    Mesh mesh = make_cube(0.0f, 1.0f);
    mesh.name = "cube";
    const Vec3 far_away = {11.0f, 0.5f, 0.5f};
    append_triangle(mesh, far_away, far_away, far_away);
    const auto result = must_bake_mesh(mesh);
    CHECK(result.report.findings.zero_area.count == 1);
    CHECK(result.report.bounds.extent == 1.0);
    CHECK(result.report.lattice.max_error >= 10.0);
    CHECK(result.report.lattice.max_error <= 10.001);
    check_refused(bake_mesh(mesh, with_tolerance(0.01)), BakeStatus::too_fine, {"cube, triangle 12:", "remove it"});
}

TEST_CASE("error: a mesh that vanishes whole gives an empty blob and no error") {
    Mesh mesh = {.positions = {{0, 0, 0}, {1, 0.2f, 0}, {0.5f, 0.1f, 0.1f}}, .triangles = {{0, 1, 2}}};
    const auto result = must_bake_mesh(mesh, with_bits(1));
    CHECK(result.report.tree.triangles == 0);
    CHECK(result.report.findings.collapsed.count == 1);
    CHECK(result.report.lattice.max_error == 0.0);
}

}  // namespace
}  // namespace espalier::tests::error_test
