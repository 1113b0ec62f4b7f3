// Claims about the reference in double precision: its tree changes nothing, and its distances between surfaces are
// those that a pencil finds.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "double_tree.hpp"
#include "hausdorff.hpp"
#include "support/base/random.hpp"
#include "support/base/test_scale.hpp"
#include "support/meshes/makers.hpp"
#include "surfaces.hpp"

namespace espalier::tests::double_tree_test {
namespace {

using namespace espalier::reference;

/// By Cramer's rule, unlike the tree's determinants of edges.
bool crosses(const PointRay& ray, const PointTriangle& t, double& at) {
    const Point e = t[1] - t[0], f = t[2] - t[0], p = cross(ray.direction, f), from = ray.origin - t[0];
    const double determinant = dot(e, p);
    if (determinant == 0.0) return false;
    const double u = dot(from, p) / determinant, v = dot(ray.direction, cross(from, e)) / determinant;
    at = dot(f, cross(from, e)) / determinant;
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && at >= 0.0;
}

PointTriangle flat_triangle(double height) { return {Point{0, 0, height}, Point{4, 0, height}, Point{0, 4, height}}; }

TEST_CASE("oracle: the tree in double precision gives the hit and the distance of the loop") {
    for (const tests::Mesh& mesh : {tests::make_soup(300, 5), tests::make_icosphere(3, 3.0, {1.0f, 2.0f, 3.0f}),
                                    tests::make_needle_fan(40), tests::make_plane_grid(9)}) {
        const DoubleTree tree(source_surface(mesh));
        Random random(17);
        for (std::size_t i = 0; i < scaled(2000); ++i) {
            const Vec3 origin = random.in_cube(8.0f), direction = random.in_cube(1.0f);
            const PointRay ray = {to_point(origin), to_point(direction)};
            double closest = std::numeric_limits<double>::infinity(), squared = closest;
            for (const PointTriangle& t : tree.triangles()) {
                double at = 0.0;
                if (crosses(ray, t, at)) closest = std::min(closest, at);
                squared = std::min(squared, squared_distance(ray.origin, t));
            }
            const ReferenceHit hit = tree.closest_hit(ray);
            REQUIRE(hit.is_hit == std::isfinite(closest));
            if (hit.is_hit) REQUIRE(hit.t == doctest::Approx(closest).epsilon(1e-9));
            REQUIRE(tree.nearest(ray.origin).squared_distance == squared);
        }
    }
}

TEST_CASE("oracle: a ray through an edge in double precision hits one side and is called doubtful") {
    const DoubleTree tree(
        {{Point{0, 0, 0}, Point{1, 0, 0}, Point{0, 1, 0}}, {Point{1, 0, 0}, Point{1, 1, 0}, Point{0, 1, 0}}});
    const ReferenceHit hit = tree.closest_hit({{0.25, 0.75, 2.0}, {0.0, 0.0, -1.0}});
    CHECK(hit.is_hit);
    CHECK(hit.t == 2.0);
    CHECK(hit.is_doubtful);
    CHECK_FALSE(tree.closest_hit({{0.25, 0.25, 2.0}, {0.0, 0.0, -1.0}}).is_doubtful);
}

TEST_CASE("oracle: the distance between surfaces is between its bounds both ways") {
    const DoubleTree low({flat_triangle(0.0)});
    const DoubleTree high({flat_triangle(3.0)});
    const OneWayDistance up = one_way_distance(low, high, 1000);
    CHECK(up.lower == doctest::Approx(3.0).epsilon(1e-12));
    CHECK(up.upper == doctest::Approx(3.0).epsilon(0.0011));
    // a part reaches the whole at once, the whole is 2 sqrt(2) from a corner cut off at half of its legs
    const DoubleTree part({{Point{0, 0, 0}, Point{2, 0, 0}, Point{0, 2, 0}}});
    CHECK(one_way_distance(part, low, 1000).upper == doctest::Approx(0.0));
    const OneWayDistance back = one_way_distance(low, part, 1000);
    CHECK(back.lower <= 2.0);
    CHECK(back.upper >= 2.0);
    CHECK(back.upper <= 2.0 * 1.002);
}

TEST_CASE("oracle: the farthest point of a triangle is found also when it is no corner") {
    // two slopes that meet above the middle: a flat triangle is farthest from them under the ridge
    const DoubleTree roof({{Point{-4, -9, 0}, Point{0, -9, 2}, Point{0, 9, 2}},
                           {Point{-4, -9, 0}, Point{0, 9, 2}, Point{-4, 9, 0}},
                           {Point{4, -9, 0}, Point{0, 9, 2}, Point{0, -9, 2}},
                           {Point{4, -9, 0}, Point{4, 9, 0}, Point{0, 9, 2}}});
    const DoubleTree floor({{Point{-4, -3, 0}, Point{4, -3, 0}, Point{0, 5, 0}}});
    const OneWayDistance distance = one_way_distance(floor, roof, 100000);
    const double expected = 4.0 * 2.0 / std::sqrt(20.0);  // from (0, y, 0) to either slope
    CHECK(distance.lower <= expected + 1e-12);
    CHECK(distance.upper >= expected);
    CHECK(distance.upper <= expected * 1.002);
    CHECK(one_way_distance(floor, roof, 1).upper >= expected);
}

}  // namespace
}  // namespace espalier::tests::double_tree_test
