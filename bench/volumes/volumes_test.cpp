// Claims about trees of volumes: volumes contain their triangles, and every kind has the answers of brute force.
#include <doctest/doctest.h>

#include "../study/aabb_tree.hpp"
#include "../study/some_meshes.hpp"
#include "../study/walks.hpp"
#include "volume_tests.hpp"
#include "trees.hpp"
#include "../study/shapes.hpp"

using namespace espalier;
using namespace espalier::bench;

namespace {

struct Trees {
    explicit Trees(const Mesh& mesh)
        : topology(build_tree_and_blob(mesh, 3).tree),
          volumes(fit_nodes(topology)),
          kinds(trees_of_all_kinds(topology, volumes)) {}

    AabbTree topology;
    std::vector<Volumes> volumes;
    std::vector<std::unique_ptr<KindOfTree>> kinds;
};

/// What was found of points that lie in k-DOPs, and of the same points, placed, in the k-DOPs that enclose these.
struct Containment {
    std::size_t inside = 0;
    std::size_t outside_once_placed = 0;
};

template <std::size_t k>
void count_points(const Volumes& volumes, const Placement& placement, double margin, tests::Random& random,
                  Containment& counts) {
    StoredDop<k> stored, turned;
    store(volumes, margin, stored);
    DopTurn<k>(placement.exact).enclose(stored.reach, turned.reach);
    const Block& box = volumes.aligned;
    const auto part = [&](double half) { return half * std::clamp(1.5 * double(random.signed_unit()), -1.0, 1.0); };
    for (int attempt = 0; attempt < 20; ++attempt) {
        const double x = part(box.half[0]), y = part(box.half[1]), z = part(box.half[2]);
        const Point point = box.center + Point{x, y, z}, placed = placement.exact(point);
        bool is_inside = true, is_placed_inside = true;
        for (std::size_t i = 0; i < k / 2; ++i) {
            const std::size_t slab = StoredDop<k>::slabs[i];
            const double before = dot(slab_directions[slab], point), after = dot(slab_directions[slab], placed);
            is_inside &= volumes.slabs.lo[slab] <= before && before <= volumes.slabs.hi[slab];
            is_placed_inside &= after <= double(turned.reach[i]) && -after <= double(turned.reach[i + k / 2]);
        }
        if (!is_inside) continue;
        ++counts.inside;
        counts.outside_once_placed += is_placed_inside ? 0u : 1u;
    }
}

}  // namespace

TEST_CASE("bench: more slabs never make a k-DOP larger and no fit has more area than the AABB") {
    for (const Mesh& mesh : some_meshes()) {
        const Trees trees(mesh);
        for (const Volumes& volumes : trees.volumes) {
            const auto area = [&](Kind kind) { return extent_of(kind, volumes).area; };
            const double most = 1.000001 * area(Kind::aabb) + 1e-9;
            CHECK(area(Kind::dop_14) <= most);
            CHECK(area(Kind::dop_18) <= most);
            CHECK(area(Kind::dop_26) <= 1.000001 * std::min(area(Kind::dop_14), area(Kind::dop_18)) + 1e-9);
            CHECK(area(Kind::obb) <= most);
        }
    }
}

TEST_CASE("bench: a 14-DOP fits an octahedron exactly") {
    const std::vector<Point> octahedron = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    const Volumes volumes = fit_volumes(octahedron);
    CHECK(extent_of(Kind::aabb, volumes).volume == doctest::Approx(8.0));
    CHECK(extent_of(Kind::aabb, volumes).area == doctest::Approx(24.0));
    CHECK(extent_of(Kind::dop_14, volumes).volume == doctest::Approx(4.0 / 3.0));
    CHECK(extent_of(Kind::dop_14, volumes).area == doctest::Approx(4.0 * std::sqrt(3.0)));
    CHECK(extent_of(Kind::dop_26, volumes).volume == doctest::Approx(4.0 / 3.0));
    CHECK(extent_of(Kind::sphere, volumes).volume == doctest::Approx(4.0 / 3.0 * 3.14159265).epsilon(0.02));
}

TEST_CASE("bench: a placed k-DOP lies in the one that encloses it") {
    tests::Random random(5);
    Containment counts;
    for (const Mesh& mesh : {tests::make_torus(24, 10, 2.0, 0.6), tests::make_soup(60, 3)}) {
        const Trees trees(mesh);
        const double margin = stored_margin_share * static_cast<double>(trees.topology.largest);
        for (const Transform& pose : poses_of(mesh, trees.topology)) {
            const Placement placement(pose);
            for (const Volumes& volumes : trees.volumes) {
                count_points<14>(volumes, placement, margin, random, counts);
                count_points<18>(volumes, placement, margin, random, counts);
                count_points<26>(volumes, placement, margin, random, counts);
            }
        }
    }
    CHECK(counts.inside > 10'000);
    CHECK(counts.outside_once_placed == 0);
}

TEST_CASE("bench: trees of every kind of volume find the closest hit that a loop over all triangles finds") {
    for (const Mesh& mesh : some_meshes()) {
        const Trees trees(mesh);
        std::vector<Ray> rays = incoherent_rays(mesh, 300, 3);
        const Vec3 center = bounding_sphere(mesh).center;
        for (const Vec3& along : {Vec3{1, 0, 0}, Vec3{0, -2, 0}, Vec3{0, 0, 3}, Vec3{1, 1, 0}})  // some lie in slabs
            rays.push_back({{center.x - 9 * along.x, center.y - 9 * along.y, center.z - 9 * along.z}, along});
        std::size_t hits = 0;
        for (const Ray& ray : rays) {
            const double expected = closest_of_all(trees.topology.triangles, ray);
            hits += std::isfinite(expected) ? 1u : 0u;
            for (const auto& tree : trees.kinds) {
                CAPTURE(mesh.name);
                CAPTURE(std::string(name_of(tree->kind())));
                RayWork work;
                CHECK(tree->closest(ray, work) == expected);
                CHECK(work.box_tests >= 1);
            }
        }
        CHECK(hits > 20);
    }
}

TEST_CASE("bench: trees of every kind of volume find the triangles in a ball that a loop over all triangles finds") {
    tests::Random random(11);
    for (const Mesh& mesh : some_meshes()) {
        const Trees trees(mesh);
        for (int i = 0; i < 100; ++i) {
            const Vec3 vertex = mesh.positions[random.below(static_cast<std::uint32_t>(mesh.positions.size()))];
            const Ball ball = {point_of(vertex) + Point{0.1 * double(random.signed_unit()), 0.0, 0.05}, 0.3};
            std::uint64_t expected = 0;
            for (const FloatTriangle& triangle : trees.topology.triangles)
                expected += touches(corners_of(triangle), ball) ? 1u : 0u;
            for (const auto& tree : trees.kinds) {
                CAPTURE(std::string(name_of(tree->kind())));
                RayWork work;
                CHECK(tree->touching(ball, work) == expected);
            }
        }
    }
}

TEST_CASE("bench: trees of every kind of volume find the pairs that a loop over all triangles finds") {
    for (const Mesh& mesh : some_meshes()) {
        const Trees trees(mesh);
        std::size_t touching = 0;
        for (const Transform& pose : poses_of(mesh, trees.topology)) {
            const Placement placement(pose);
            const PairWork expected = test_all_pairs(trees.topology, trees.topology, placement);
            touching += expected.pairs > 0 ? 1u : 0u;
            for (const auto& tree : trees.kinds) {
                CAPTURE(mesh.name);
                CAPTURE(std::string(name_of(tree->kind())));
                RayWork work;
                CHECK(tree->touching(placement, work) == expected.pairs);
                CHECK(work.triangle_tests <= expected.triangle_tests);
            }
        }
        CHECK(touching > 5);
        CHECK(touching < 15);
    }
}
