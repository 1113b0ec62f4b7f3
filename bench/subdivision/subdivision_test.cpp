// Claims about subdivisions: they have the answers of a loop over all triangles, and cells hold what touches them.
#include <doctest/doctest.h>

#include "../study/some_meshes.hpp"
#include "structures.hpp"

using namespace espalier;
using namespace espalier::bench;

namespace {

std::vector<Mesh> all_meshes() {
    std::vector<Mesh> meshes = some_meshes();
    meshes.push_back(tests::make_needle_fan(40));
    return meshes;
}

/// Along axes and through corners, too: there rays run along the borders of cells.
std::vector<Ray> some_rays(const SubdivisionSubject& subject) {
    std::vector<Ray> rays = incoherent_rays(subject.snapped.mesh, 300, 3);
    for (std::size_t i = 0; i < 100; ++i) {
        const Vec3 p = subject.built.tree.triangles[i % subject.built.tree.triangles.size()][i % 3];
        rays.push_back({.origin = {p.x, p.y, p.z + 1000.0f}, .direction = {0.0f, 0.0f, -1.0f}});
        rays.push_back({.origin = {p.x - 1000.0f, p.y, p.z}, .direction = {1.0f, 0.0f, 0.0f}});
        rays.push_back({.origin = {p.x, p.y + 500.0f, p.z + 500.0f}, .direction = {0.0f, -1.0f, -1.0f}});
        rays.push_back({.origin = p, .direction = {0.3f, -0.2f, 0.9f}});
    }
    return rays;
}

std::vector<Aabb> some_boxes(const SubdivisionSubject& subject) {
    tests::Random random(5);
    std::vector<Aabb> boxes;
    const auto& triangles = subject.built.tree.triangles;
    for (std::size_t i = 0; i < 200; ++i) {
        const Vec3& p = triangles[random.below(static_cast<std::uint32_t>(triangles.size()))][random.below(3)];
        const float half = i % 4 == 0 ? 0.0f : static_cast<float>(random.below(1000)) * 0.05f;
        boxes.push_back({{p.x - half, p.y - half, p.z - half}, {p.x + half, p.y + half, p.z + half}});
    }
    boxes.push_back({{1e6f, 1e6f, 1e6f}, {2e6f, 2e6f, 2e6f}});
    return boxes;
}

}  // namespace

TEST_CASE("bench: a k-d tree and a grid have the hits and the triangles in boxes of a loop over all triangles") {
    for (const Mesh& mesh : all_meshes()) {
        const SubdivisionSubject subject = make_subdivision_subject(mesh);
        const auto& triangles = subject.built.tree.triangles;
        for (const auto& structure : all_structures(subject)) {
            if (!structure->is_reference) continue;
            CAPTURE(mesh.name);
            CAPTURE(structure->name);
            std::size_t differing_rays = 0, differing_boxes = 0;
            RayWork work;
            for (const Ray& ray : some_rays(subject))
                differing_rays += structure->closest(ray, work) != closest_of_all(triangles, ray) ? 1u : 0u;
            CHECK(differing_rays == 0);
            CHECK(work.box_tests > 0);
            for (const Aabb& box : some_boxes(subject))  // each triangle once
                differing_boxes += structure->count_touching(box, work) != touching_of_all(triangles, box) ? 1u : 0u;
            CHECK(differing_boxes == 0);
        }
    }
}

TEST_CASE("bench: cells with a margin lose no ray at edges and vertices") {
    const SubdivisionSubject subject = make_subdivision_subject(tests::make_torus(60, 30, 2.0, 0.5));
    for (const auto& structure : all_structures(subject))
        for (const AimedAt aim : all_aims) {
            CAPTURE(structure->name);
            std::size_t lost = 0;
            RayWork work;
            for (const EdgeRay& aimed : edge_rays(subject.snapped, aim, 5'000, 7))
                lost += is_leak(aimed, static_cast<float>(structure->closest(aimed.ray, work))) ? 1u : 0u;
            CHECK(lost == 0);
        }
}
