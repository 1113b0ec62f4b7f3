// Claims about walks: every rule of descent and every order of children has the answers of a test of all triangles.
#include <doctest/doctest.h>

#include "../study/aabb_tree.hpp"
#include "../study/some_meshes.hpp"
#include "../study/walks.hpp"

using namespace espalier;
using namespace espalier::bench;

namespace {

constexpr unsigned leaf_triangles = 3;

AabbTree tree_of(const Mesh& mesh) { return build_tree_and_blob(mesh, leaf_triangles).tree; }

}  // namespace

TEST_CASE("bench: boxes of a textbook tree are larger than even flat triangles") {
    for (const Mesh& mesh : some_meshes()) {
        const AabbTree tree = tree_of(mesh);
        std::size_t triangles = 0, outside = 0;
        for (const AabbNode& node : tree.nodes) {
            if (!node.is_leaf()) continue;
            triangles += node.count;
            for (const FloatTriangle& triangle : tree.triangles_of(node))
                for (const Vec3& p : triangle) {
                    const float away[3] = {std::abs(p.x - node.center[0]), std::abs(p.y - node.center[1]),
                                           std::abs(p.z - node.center[2])};
                    for (int k = 0; k < 3; ++k) outside += away[k] + 1e-6f * tree.largest > node.half[k] ? 1u : 0u;
                }
        }
        CHECK(triangles == mesh.triangles.size());
        CHECK(outside == 0);
    }
}

TEST_CASE("bench: every rule of descent finds the pairs that a loop over all triangles finds") {
    for (const Mesh& mesh : some_meshes()) {
        const AabbTree tree = tree_of(mesh);
        PairWalk walk(tree, tree);
        std::size_t touching = 0;
        for (const Transform& pose : poses_of(mesh, tree)) {
            const Placement placement(pose);
            const PairWork expected = test_all_pairs(tree, tree, placement);
            touching += expected.pairs > 0 ? 1u : 0u;
            for (const PairRule rule : all_pair_rules) {
                CAPTURE(mesh.name);
                CAPTURE(std::string(name_of(rule)));
                const PairWork all = walk.run(rule, PairQuestion::all, placement);
                CHECK(all.pairs == expected.pairs);
                CHECK(all.triangle_tests <= expected.triangle_tests);
                CHECK(walk.run(rule, PairQuestion::any, placement).pairs == std::min<std::uint64_t>(all.pairs, 1));
            }
        }
        CHECK(touching > 5);
        CHECK(touching < 15);
    }
}

TEST_CASE("bench: rules of descent test the same leaves where all pairs are sought") {
    const Mesh mesh = tests::make_torus(40, 20, 2.0, 0.6);
    const AabbTree tree = tree_of(mesh);
    PairWalk walk(tree, tree);
    for (const Transform& pose : poses_of(mesh, tree)) {
        const Placement placement(pose);
        const PairWork first = walk.run(all_pair_rules[0], PairQuestion::all, placement);
        for (const PairRule rule : all_pair_rules)
            CHECK(walk.run(rule, PairQuestion::all, placement).triangle_tests == first.triangle_tests);
    }
}

TEST_CASE("bench: two different trees are walked by every rule") {
    const Mesh torus = tests::make_torus(24, 10, 2.0, 0.6), ball = tests::make_icosphere(2, 1.9, {});
    const AabbTree a = tree_of(torus), b = tree_of(ball);
    PairWalk walk(a, b);
    Transform pose;
    pose.rotation = {0.3f, -0.2f, 0.1f, 0.9f};
    const Placement placement(pose);
    const PairWork expected = test_all_pairs(a, b, placement);
    CHECK(expected.pairs > 50);
    for (const PairRule rule : all_pair_rules)
        CHECK(walk.run(rule, PairQuestion::all, placement).pairs == expected.pairs);
}

TEST_CASE("bench: every order of children finds the hit that a loop over all triangles finds") {
    for (const Mesh& mesh : some_meshes()) {
        const AabbTree tree = tree_of(mesh);
        RayWalk walk(tree);
        std::size_t hits = 0;
        for (const Ray& ray : incoherent_rays(mesh, 2'000, 3)) {
            const double expected = closest_of_all(tree.triangles, ray);
            hits += expected < std::numeric_limits<double>::infinity() ? 1u : 0u;
            for (const RayOrder order : all_ray_orders) {
                RayWork work;
                const double found = walk.closest(order, ray, work);
                CHECK_MESSAGE(found == expected, mesh.name, ", ", std::string(name_of(order)));
                CHECK(work.box_tests % 2 == 1);
            }
        }
        CHECK(hits > 500);
    }
}

TEST_CASE("bench: a ray along an axis finds its hit in a flat box") {
    const Mesh mesh = tests::make_plane_grid(12);
    const AabbTree tree = tree_of(mesh);
    const Vec3 middle = bounding_sphere(mesh).center;
    RayWalk walk(tree);
    for (const float side : {-1.0f, 1.0f}) {
        Ray ray;
        ray.origin = {middle.x + 0.01f, middle.y + 0.02f, middle.z + 3.0f * side};
        ray.direction = {0.0f, -0.0f, -side};
        for (const RayOrder order : all_ray_orders) {
            RayWork work;
            CHECK(walk.closest(order, ray, work) == 3.0);
            CHECK(work.triangle_tests < 20);
        }
    }
}

TEST_CASE("bench: two triangles touch if no axis separates them") {
    tests::Random random(11);
    const auto some_triangle = [&](float half_side, float step) {
        FloatTriangle triangle;
        for (Vec3& corner : triangle) {
            corner = random.in_cube(half_side);
            // Whole steps: corners in the plane of the other triangle, common corners, common planes.
            if (step > 0.0f)
                corner = {step * std::round(corner.x / step), step * std::round(corner.y / step),
                          step * std::round(corner.z / step)};
        }
        return triangle;
    };
    Pose in_place;
    in_place.rotation = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    in_place.shift = {0, 0, 0};
    for (const float step : {0.0f, 1.0f}) {
        std::size_t touching = 0, differing = 0;
        for (std::size_t i = 0; i < 20'000; ++i) {
            const FloatTriangle a = some_triangle(2.0f, step), b = some_triangle(2.0f, step);
            const bool expected = touch(corners_of(a), corners_of(b));
            touching += expected ? 1u : 0u;
            differing += PlacedTriangle(b, in_place, 2.0).touches(a) != expected ? 1u : 0u;
        }
        CHECK(differing == 0);
        CHECK(touching > 2'000);
        CHECK(touching < 18'000);
    }
}
