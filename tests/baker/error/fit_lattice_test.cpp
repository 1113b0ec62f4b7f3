// Claims about the search for the lattice that keeps a tolerance, and about what snapping to it stores.
#include "support/testing.hpp"

#include <baker/quantise/lattice.hpp>
#include <baker/quantise/snap.hpp>

#include "baker/baking_support.hpp"

namespace espalier::tests::fit_lattice_test {
namespace {

TEST_CASE("lattice: a vertex off the coarser lattices is kept within the tolerance") {
    // A square on a coarse grid, and on it a triangle of one fine step, which a step of two would make a point.
    const float s = 0x1p-7f;
    Mesh mesh = make_plane_grid(1);
    for (Vec3& point : mesh.positions) point = {point.x * 64.0f, point.y * 64.0f, 0.0f};
    append_triangle(mesh, {101 * s, 101 * s, 0.0f}, {100 * s, 101 * s, 0.0f}, {100 * s, 100 * s, 0.0f});
    const auto result = must_bake_mesh(mesh, with_tolerance(0.9 * double(s)));
    CHECK(result.report.tree.triangles == 3);
    CHECK(result.report.lattice.step == double(s));
}

TEST_CASE("lattice: an error of exactly the tolerance is accepted") {
    for (const Mesh& mesh : {make_terrain(12, 4), make_torus(20, 10, 3.0, 1.0)}) {
        const auto first = must_bake_mesh(mesh, with_tolerance(0.01));
        const double error = first.report.lattice.max_error;
        REQUIRE(error > 0.0);
        const auto again = must_bake_mesh(mesh, with_tolerance(error));
        CHECK(again.report.lattice.step == first.report.lattice.step);
        CHECK(again.report.lattice.max_error == error);
    }
}

TEST_CASE("lattice: the coarsest step of the format is the limit for every mesh and tolerance") {
    const auto result = must_bake_mesh(make_cube(0.0f, 0x1p110f), with_tolerance(1e37));
    CHECK(result.report.lattice.step == 0x1p100);
    CHECK(result.report.tree.triangles == 12);
}

TEST_CASE("lattice: the finest step of the format becomes coarser where the mesh allows it") {
    const auto result = must_bake_mesh(make_cube(0.0f, 0x1p-90f), with_tolerance(0.9 * 0x1p-100));
    CHECK(result.report.lattice.step == 0x1p-94);
    CHECK(result.report.lattice.max_error == 0.0);
    for (const double tolerance : {0x1p-101, 0x1p-102, 0x1p-600}) {
        check_refused(bake_mesh(make_cube(0.0f, 1.0f), with_tolerance(tolerance)), BakeStatus::too_fine, {});
    }
}

TEST_CASE("lattice: a triangle without area whose error has no float32 is refused by name") {
    Mesh mesh = make_cube(0.0f, 1.0f);
    const Vec3 far = {3e38f, 3e38f, 3e38f};
    append_triangle(mesh, far, far, far);
    check_refused(bake_mesh(mesh), BakeStatus::too_large, {"triangle 12", "remove it from the mesh"});
}

TEST_CASE("weld: several positions that snap to one lattice point are stored once") {
    baker::Source source;
    source.positions = {{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {9, 0.25, 0}, {9, 9, 0}, {0, 9, 0.25}};
    source.triangles = {{{0, 1, 2}, 0}, {{3, 4, 5}, 1}};
    Findings findings;
    const baker::LatticeMesh mesh = baker::snap_and_weld(source, {{0, 0, 0}, 0, 4}, findings);
    CHECK(mesh.vertices.size() == 4);
    CHECK(mesh.used_vertices == 4);
    CHECK(mesh.triangles.size() == 2);
}

}  // namespace
}  // namespace espalier::tests::fit_lattice_test
