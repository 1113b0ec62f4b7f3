// Aimed rays are what they are said to be, and kernels find the same hits.

#include <doctest/doctest.h>

#include "edge_rays.hpp"
#include "kernels.hpp"

namespace espalier::bench {
namespace {

struct Subject {
    explicit Subject(const Mesh& mesh)
        : snapped(snap_mesh(mesh)), built(build_tree_and_blob(snapped.mesh, 4)), blob(built.baked.blob) {}
    SnappedMesh snapped;
    TreeAndBlob built;
    Blob blob;
};

std::vector<Mesh> some_meshes() {
    return {tests::make_icosphere(2, 1.0, {0.3f, 0.2f, 0.1f}), tests::make_uv_sphere(8, 12, 1.0, {}),
            tests::make_torus(16, 8, 1.0, 0.3), tests::make_terrain(12, 1), tests::make_cube(-1.0f, 2.0f)};
}

/// Returns whether the line of the ray goes through the point, exactly: coordinates are whole in half steps, of up to
/// 24 bits, and directions have 12 bits.
bool passes_through(const Ray& ray, const Vec3& point) {
    const double x = double(point.x) - double(ray.origin.x), y = double(point.y) - double(ray.origin.y),
                 z = double(point.z) - double(ray.origin.z);
    const double dx = double(ray.direction.x), dy = double(ray.direction.y), dz = double(ray.direction.z);
    return x * dy == y * dx && y * dz == z * dy && z * dx == x * dz;
}

TEST_CASE("bench: a ray that is aimed at a vertex or an edge meets the surface there") {
    for (const Mesh& mesh : some_meshes()) {
        const Subject subject(mesh);
        const AabbTree& tree = subject.built.tree;
        const Integers integers(tree, subject.blob);
        const Watertight watertight(tree, subject.blob);
        for (const AimedAt aim : all_aims) {
            const std::vector<EdgeRay> rays = edge_rays(subject.snapped, aim, 300, 1);
            REQUIRE(!rays.empty());
            for (const EdgeRay& aimed : rays) {
                CHECK(!is_leak(aimed, closest_of_all(tree, integers, aimed.ray)));
                CHECK(!is_leak(aimed, closest_of_all(tree, watertight, aimed.ray)));
                CHECK(!is_leak(aimed, raycast(subject.blob, aimed.ray).t));
            }
        }
    }
}

TEST_CASE("bench: a ray that is aimed at a vertex passes through it exactly") {
    const Subject subject(tests::make_torus(16, 8, 1.0, 0.3));
    for (const EdgeRay& aimed : edge_rays(subject.snapped, AimedAt::vertex, 300, 2))
        CHECK(std::ranges::any_of(subject.snapped.mesh.positions,
                                  [&](const Vec3& p) { return passes_through(aimed.ray, p); }));
}

TEST_CASE("bench: a hit behind the surface or none is a leak") {
    const EdgeRay ray{{}, 2.0f};
    CHECK(!is_leak(ray, 1.0f));
    CHECK(!is_leak(ray, 2.0f));
    CHECK(is_leak(ray, 2.5f));
    CHECK(is_leak(ray, std::numeric_limits<float>::infinity()));
    CHECK(is_leak(ray, std::numeric_limits<float>::quiet_NaN()));
}

TEST_CASE("bench: no ray is aimed at the border of an open mesh") {
    Mesh mesh;
    mesh.name = "one triangle";
    mesh.positions = {{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}};
    mesh.triangles = {{0, 1, 2}};
    for (const AimedAt aim : all_aims) CHECK(edge_rays(snap_mesh(mesh), aim, 10, 1).empty());
}

template <class Kernel>
void check_kernel(const Subject& subject, const std::vector<Ray>& rays) {
    const Kernel kernel(subject.built.tree, subject.blob);
    RayWalk walk(subject.built.tree);
    for (const Ray& ray : rays) {
        const float t = closest_hit(walk, kernel, ray);
        CHECK(t == closest_of_all(subject.built.tree, kernel, ray));
        const float expected = raycast(subject.blob, ray).t;
        CHECK((t == expected || std::abs(t - expected) <= 1e-4f));
    }
}

TEST_CASE("bench: kernels in float and double and integers find the same hits") {
    for (const Mesh& mesh : some_meshes()) {
        const Subject subject(mesh);
        const std::vector<Ray> rays = incoherent_rays(subject.snapped.mesh, 500, 3);
        check_kernel<MollerTrumbore<float>>(subject, rays);
        check_kernel<MollerTrumbore<double>>(subject, rays);
        check_kernel<Watertight>(subject, rays);
        check_kernel<Integers>(subject, rays);
    }
}

}  // namespace
}  // namespace espalier::bench
