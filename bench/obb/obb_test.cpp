// Claims about convex hulls, about boxes that are fitted to points, and about trees of these.
#include <doctest/doctest.h>

#include <map>
#include <tuple>

#include "../study/aabb_tree.hpp"
#include "../study/some_meshes.hpp"
#include "hull.hpp"
#include "fits.hpp"
#include "box_trees.hpp"

using namespace espalier;
using namespace espalier::bench;

namespace {

constexpr std::array fits_of_hull = {BoxFit::vertices, BoxFit::hull, BoxFit::flush, BoxFit::search};

double length_of(const Point& p) { return std::sqrt(dot(p, p)); }
double signed_unit(tests::Random& random) { return static_cast<double>(random.signed_unit()); }

/// Returns perpendicular axes of length 1, at random.
BoxAxes some_axes(tests::Random& random) {
    for (;;) {
        const Point a = {signed_unit(random), signed_unit(random), signed_unit(random)};
        const Point b = {signed_unit(random), signed_unit(random), signed_unit(random)};
        const Point c = cross(a, b);
        if (length_of(a) < 0.1 || length_of(c) < 0.1) continue;
        const Point x = (1.0 / length_of(a)) * a, z = (1.0 / length_of(c)) * c;
        return {x, cross(z, x), z};
    }
}

Point point_in(const Block& box, double x, double y, double z) {
    return box.center + (x * box.half[0]) * box.axes[0] + (y * box.half[1]) * box.axes[1] +
           (z * box.half[2]) * box.axes[2];
}

Block some_box(tests::Random& random) {
    Block box;
    box.axes = some_axes(random);
    box.center = {10.0 * signed_unit(random), 10.0 * signed_unit(random), 10.0 * signed_unit(random)};
    for (double& half : box.half) half = std::exp(2.0 * signed_unit(random));
    return box;
}

/// Returns the corners, and points of the surface.
std::vector<Point> points_of(const Block& box, std::size_t count, tests::Random& random) {
    std::vector<Point> points;
    for (int corner = 0; corner < 8; ++corner)
        points.push_back(point_in(box, corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1));
    for (std::size_t i = 0; i < count; ++i) {
        std::array<double, 3> at = {signed_unit(random), signed_unit(random), signed_unit(random)};
        at[random.below(3)] = random.coin() ? 1.0 : -1.0;
        points.push_back(point_in(box, at[0], at[1], at[2]));
    }
    return points;
}

bool does_contain(const Block& box, const Point& point, double rounding) {
    for (std::size_t k = 0; k < 3; ++k)
        if (std::abs(dot(box.axes[k], point - box.center)) > box.half[k] + rounding) return false;
    return true;
}

double size_of(std::span<const Point> points) {
    const Block box = fit_box(BoxFit::aligned, points);
    return 2.0 * std::max({box.half[0], box.half[1], box.half[2]});
}

/// Checks that each edge has two triangles, in opposite directions, and that no point is outside.
void check_closed_and_convex(const HullMesh& hull, std::span<const Point> points) {
    REQUIRE(hull.dimension == 3);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const HullMesh::Triangle& t : hull.triangles)
        for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
    std::size_t unpaired = 0;
    for (const auto& [edge, count] : edges)
        unpaired += count != 1 || edges.count({edge.second, edge.first}) != 1 ? 1u : 0u;
    CHECK(unpaired == 0);
    CHECK(hull.vertices.size() + hull.triangles.size() == edges.size() / 2 + 2);  // Euler
    const double most = 4.0 * float_rounding_share * size_of(points);
    std::size_t outside = 0;
    for (const auto& [a, b, c] : hull.triangles) {
        const Point& corner = hull.vertices[a];
        const Point across = cross(hull.vertices[b] - corner, hull.vertices[c] - corner);
        const double length = length_of(across);
        if (length < 1e-6 * size_of(points) * size_of(points)) continue;  // a sliver: its plane is uncertain
        for (const Point& p : points) outside += dot(across, p - corner) > most * length ? 1u : 0u;
    }
    CHECK(outside == 0);
}

std::vector<Point> points_of(const Mesh& mesh) {
    std::vector<Point> points;
    for (const Vec3& p : mesh.positions) points.push_back(point_of(p));
    return points;
}

}  // namespace

TEST_CASE("bench: a convex hull is closed and has no point outside") {
    tests::Random random(1);
    for (const Mesh& mesh :
         {tests::make_torus(24, 10, 2.0, 0.6), tests::make_icosphere(3, 1.5, {4.0f, 0.0f, 0.0f}),
          tests::make_terrain(14, 1), tests::make_soup(300, 2), tests::make_cube(-1.0f, 2.0f), tests::make_far_sphere(),
          tests::make_needle_fan(100), tests::make_slivers(200, 3), tests::make_coplanar_stacks(200, 4)}) {
        CAPTURE(mesh.name);
        const std::vector<Point> points = points_of(mesh);
        const HullMesh hull = convex_hull_of(points);
        if (hull.dimension == 3) check_closed_and_convex(hull, points);
    }
    for (int i = 0; i < 100; ++i) {
        const std::vector<Point> points = points_of(some_box(random), 500, random);
        check_closed_and_convex(convex_hull_of(points), points);
    }
}

TEST_CASE("bench: the convex hull of a grid of points in a cube has its volume") {
    std::vector<Point> grid;
    for (int x = 0; x <= 8; ++x)
        for (int y = 0; y <= 8; ++y)
            for (int z = 0; z <= 8; ++z) grid.push_back({x / 8.0, y / 8.0, z / 8.0});
    const HullMesh hull = convex_hull_of(grid);
    check_closed_and_convex(hull, grid);
    double volume = 0.0;
    for (const auto& [a, b, c] : hull.triangles)
        volume += dot(hull.vertices[a], cross(hull.vertices[b], hull.vertices[c])) / 6.0;
    CHECK(volume == doctest::Approx(1.0));
}

TEST_CASE("bench: the convex hull of points in a plane or on a line or at one place has fewer dimensions") {
    tests::Random random(2);
    for (int i = 0; i < 100; ++i) {
        Block box = some_box(random);
        for (unsigned dimension = 3; dimension-- > 0;) {
            box.half[dimension] = 0.0;
            const std::vector<Point> points = points_of(box, 50, random);
            const HullMesh hull = convex_hull_of(points);
            REQUIRE(hull.dimension <= dimension);
            if (box.half[0] > 0.0) CHECK(hull.dimension == dimension);
            for (const BoxFit fit : fits_of_hull) {
                const Block fitted = fit_box(fit, points);
                const double size = size_of(points);
                for (const Point& p : points) CHECK(does_contain(fitted, p, 1e-12 * (size + 10.0)));
                std::array<double, 3> half = fitted.half;
                std::sort(half.begin(), half.end());
                for (unsigned k = 0; k + dimension < 3; ++k) CHECK(half[k] < 1e-7 * size + 1e-12);
            }
            if (dimension != 2) continue;
            Block fitted = fit_box(BoxFit::search, points);
            std::sort(fitted.half.begin(), fitted.half.end());
            CHECK(fitted.half[1] * fitted.half[2] == doctest::Approx(box.half[0] * box.half[1]).epsilon(1e-6));
        }
    }
    const std::vector<Point> one = {{1.0, 2.0, 3.0}};
    for (const BoxFit fit : fits_of_hull) CHECK(volume_of(fit_box(fit, one)) == 0.0);
}

TEST_CASE(
    "bench: no fit is smaller than a box turned at random whose surface it encloses and the search finds that box") {
    tests::Random random(3);
    double worst_of_vertices = 1.0;
    for (int i = 0; i < 200; ++i) {
        const Block box = some_box(random);
        const std::vector<Point> points = points_of(box, 400, random);
        for (const BoxFit fit : all_box_fits) {
            CAPTURE(std::string(name_of(fit)));
            const Block fitted = fit_box(fit, points);
            std::size_t outside = 0;
            for (const Point& p : points) outside += does_contain(fitted, p, 1e-12 * size_of(points)) ? 0u : 1u;
            CHECK(outside == 0);
            const double share = volume_of(fitted) / volume_of(box);
            CHECK(share > 1.0 - 1e-12);
            if (fit == BoxFit::flush || fit == BoxFit::search) CHECK(share < 1.0 + 1e-9);
            if (fit == BoxFit::vertices) worst_of_vertices = std::max(worst_of_vertices, share);
            for (std::size_t k = 0; k < 3; ++k) {
                CHECK(std::abs(dot(fitted.axes[k], fitted.axes[(k + 1) % 3])) < 1e-12);
                CHECK(std::abs(length_of(fitted.axes[k]) - 1.0) < 1e-12);
            }
        }
    }
    CHECK(worst_of_vertices > 1.1);  // so that there is something to search
}

TEST_CASE("bench: the search finds the cube around a regular tetrahedron although no side is on a face") {
    tests::Random random(4);
    for (int i = 0; i < 50; ++i) {
        Block box = some_box(random);
        box.half = {1.0, 1.0, 1.0};
        const std::vector<Point> points = {point_in(box, 1, 1, 1), point_in(box, 1, -1, -1), point_in(box, -1, 1, -1),
                                           point_in(box, -1, -1, 1)};
        CHECK(volume_of(fit_box(BoxFit::search, points)) == doctest::Approx(8.0).epsilon(1e-3));
        CHECK(volume_of(fit_box(BoxFit::flush, points)) == doctest::Approx(16.0).epsilon(1e-9));
    }
}

TEST_CASE("bench: the search is the smallest of the fits") {
    for (const Mesh& mesh :
         {tests::make_torus(24, 10, 2.0, 0.6), tests::make_terrain(14, 1), tests::make_soup(20, 2)}) {
        const std::vector<Point> points = points_of(mesh);
        const double least = volume_of(fit_box(BoxFit::search, points));
        for (const BoxFit fit : all_box_fits) CHECK(volume_of(fit_box(fit, points)) >= (1.0 - 1e-9) * least);
    }
}

TEST_CASE("bench: dense vertices turn the fit to vertices and not the one to the surface of the hull") {
    std::vector<Point> points;
    for (int corner = 0; corner < 8; ++corner)
        points.push_back({corner & 1 ? 3.0 : -3.0, corner & 2 ? 2.0 : -2.0, corner & 4 ? 1.0 : -1.0});
    const double exact = volume_of(fit_box(BoxFit::hull, points));
    CHECK(exact == doctest::Approx(48.0));
    for (int i = 0; i < 1000; ++i) points.push_back({0.0029 * i, 0.0019 * i, 0.0009 * i});
    CHECK(volume_of(fit_box(BoxFit::vertices, points)) > 1.5 * exact);
    CHECK(volume_of(fit_box(BoxFit::hull, points)) == doctest::Approx(exact));
}

namespace {

AabbTree tree_of(const Mesh& mesh) { return build_tree_and_blob(mesh, 1).tree; }

/// Counts the corners of triangles that are outside of the oriented box of a node above them.
std::size_t corners_outside(const AabbTree& tree, const BoxNodes<StoredObb>& boxes) {
    const std::vector<TriangleRange> ranges = triangle_ranges(tree);
    std::size_t outside = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const StoredObb& box = boxes[i];
        for (std::size_t t = ranges[i].first; t < ranges[i].end; ++t)
            for (const Vec3& p : tree.triangles[t]) {
                const float away[3] = {p.x - box.center[0], p.y - box.center[1], p.z - box.center[2]};
                const auto away_along = [&](const float(&axis)[3]) {
                    return axis[0] * away[0] + axis[1] * away[1] + axis[2] * away[2];
                };
                bool is_outside = false;
                for (int k = 0; k < 3; ++k) is_outside |= std::abs(away_along(box.axes[k])) > box.half[k];
                outside += is_outside ? 1u : 0u;
            }
    }
    return outside;
}

/// Checks that trees of all kinds have the answers of a test of all triangles, and returns that number of contacts.
std::uint64_t check_answers(const MeshTrees& a, const MeshTrees& b, const Transform& pose) {
    const PairWork expected = test_all_pairs(*a.sah, *b.sah, Placement(pose));
    for (const TreeKind& kind : all_tree_kinds()) {
        CAPTURE(std::string(kind.topology));
        CAPTURE(std::string(kind.boxes));
        const PairWork all = kind.walk(a, b, PairQuestion::all)(pose);
        CHECK(all.pairs == expected.pairs);
        CHECK(all.triangle_tests <= expected.triangle_tests);
        CHECK(kind.walk(a, b, PairQuestion::any)(pose).pairs == std::min<std::uint64_t>(expected.pairs, 1));
    }
    return expected.pairs;
}

}  // namespace

TEST_CASE("bench: a tree built by oriented boxes has each triangle once in boxes that contain it") {
    for (const Mesh& mesh : some_meshes()) {
        CAPTURE(mesh.name);
        const AabbTree sah = tree_of(mesh);
        const ObbTree built = build_obb_tree(sah.triangles);
        CHECK(built.tree.nodes.size() == 2 * sah.triangles.size() - 1);
        const auto sorted = [](std::vector<FloatTriangle> triangles) {
            std::sort(triangles.begin(), triangles.end(), [](const FloatTriangle& a, const FloatTriangle& b) {
                for (std::size_t k = 0; k < 3; ++k)
                    if (std::tie(a[k].x, a[k].y, a[k].z) != std::tie(b[k].x, b[k].y, b[k].z))
                        return std::tie(a[k].x, a[k].y, a[k].z) < std::tie(b[k].x, b[k].y, b[k].z);
                return false;
            });
            return triangles;
        };
        const auto expected = sorted(sah.triangles), found = sorted(built.tree.triangles);
        REQUIRE(found.size() == expected.size());
        std::size_t differing = 0;
        for (std::size_t i = 0; i < found.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 &a = found[i][k], &b = expected[i][k];
                differing += a.x != b.x || a.y != b.y || a.z != b.z ? 1u : 0u;
            }
        CHECK(differing == 0);
        CHECK(corners_outside(built.tree, built.boxes) == 0);
        CHECK(corners_outside(sah, fit_obbs(sah)) == 0);
    }
}

TEST_CASE("bench: trees of oriented and of axis-aligned boxes find the pairs that a loop over all triangles finds") {
    BuildSeconds seconds;
    for (const Mesh& mesh : some_meshes()) {
        CAPTURE(mesh.name);
        const AabbTree sah = tree_of(mesh);
        const MeshTrees trees(sah, seconds);
        std::size_t touching = 0;
        for (const Transform& pose : poses_of(mesh, sah)) touching += check_answers(trees, trees, pose) > 0 ? 1u : 0u;
        CHECK(touching > 5);
        CHECK(touching < 15);
    }
}

TEST_CASE("bench: trees answer alike for parallel surfaces that do not touch where a mesh has room for the gap") {
    BuildSeconds seconds;
    const Mesh torus = tests::make_torus(24, 10, 2.0, 0.6), soup = tests::make_soup(300, 2);
    for (const Mesh* mesh : {&torus, &soup}) {
        const AabbTree sah = tree_of(*mesh);
        const MeshTrees trees(sah, seconds);
        const ParallelSurface parallel = parallel_surface_of(*mesh, 0.01);
        const AabbTree second = tree_of(parallel.mesh);
        const MeshTrees second_trees(second, seconds);
        const bool is_touching = check_answers(trees, second_trees, parallel.pose) > 0;
        CHECK(is_touching == (mesh == &soup));
    }
}
