// What a deformable bake refuses: the message names the mesh, the pose and the vertex.
#include "support/testing.hpp"

#include "baker/baking_support.hpp"
#include "support/blobs/deformed_mesh.hpp"

namespace espalier::tests::check_deformation_test {
namespace {

BakeOptions deforming() {
    BakeOptions options = with_profile(Profile::fast);
    options.deformation.emplace();
    return options;
}

TEST_CASE("deformation: options that exclude a deformable blob are refused") {
    const Mesh mesh = make_plane_grid(3);
    for (const Profile profile : {Profile::balanced, Profile::small, Profile::tiny}) {
        BakeOptions options = deforming();
        options.profile = profile;
        check_refused(bake_mesh(mesh, options), BakeStatus::invalid_options, {"deformable", "profile fast"});
    }
    const auto check = [&](BakeOptions options, std::initializer_list<std::string> parts) {
        options.profile = Profile::fast;
        options.deformation.emplace();
        check_refused(bake_mesh(mesh, options), BakeStatus::invalid_options, parts);
    };
    check({.build = {.builder = Builder::spatial_splits}}, {"spatial_splits"});
    check({.drop_bad_triangles = true}, {"drop_bad_triangles"});
    check({.flat_angle = 5.0}, {"edge flags", "one pose"});
    for (unsigned kind = 0; kind < 3; ++kind)
        check({.bounds = {kind == 0, kind == 1, kind == 2}}, {"bounds", "one pose"});
}

TEST_CASE("deformation: a range that is not a box is refused with its axis") {
    const Mesh mesh = make_plane_grid(3);
    const auto with_range = [&](Vec3 low, Vec3 high) {
        BakeOptions options = deforming();
        options.deformation->range = Box{low, high};
        return bake_mesh(mesh, options);
    };
    check_refused(with_range({0, 2, 0}, {1, 1, 1}), BakeStatus::invalid_options, {"from 2 to 1 on y"});
    for (const float bad : {not_a_number, infinity, -infinity}) {
        check_refused(with_range({0, 0, bad}, {1, 1, 1}), BakeStatus::invalid_options, {"not finite"});
        check_refused(with_range({0, 0, 0}, {bad, 1, 1}), BakeStatus::invalid_options, {"not finite"});
    }
    Mesh point = make_plane_grid(1);
    for (Vec3& p : point.positions) p = {1.0f, 2.0f, 3.0f};
    check_refused(bake_mesh(point, deforming()), BakeStatus::invalid_options, {"range of motion is a point"});
    BakeOptions options = deforming();
    options.deformation->range = Box{{0, 0, 0}, {3, 3, 3}};
    CHECK(bake_mesh(point, options));
}

TEST_CASE("deformation: positions that are not finite are refused with mesh and vertex") {
    Mesh mesh = make_plane_grid(3);
    mesh.name = "cloth.obj";
    const Mesh first = make_cube(0.0f, 1.0f);
    mesh.positions.push_back({0.0f, not_a_number, 0.0f});  // of no triangle
    const std::string vertex = "cloth.obj, vertex " + std::to_string(mesh.positions.size() - 1) + " has y = NaN";
    check_refused(bake_mesh(mesh, deforming()), BakeStatus::invalid_mesh, {vertex});
    check_refused(bake_meshes({&first, &mesh}, deforming()), BakeStatus::invalid_mesh, {vertex});
    mesh.positions.back() = {0.0f, 0.0f, -infinity};
    check_refused(bake_mesh(mesh, deforming()), BakeStatus::invalid_mesh, {"z = -infinity"});
}

TEST_CASE("deformation: poses that do not fit are refused with their number") {
    const Mesh mesh = make_plane_grid(3);
    BakeOptions options = deforming();
    options.deformation->poses = {mesh.positions, mesh.positions};
    options.deformation->poses[1].pop_back();
    check_refused(bake_mesh(mesh, options), BakeStatus::invalid_mesh,
                  {"pose 2 of 2 has 15 positions", "the meshes have 16"});
    options.deformation->poses[1] = mesh.positions;
    options.deformation->poses[0][7].x = infinity;
    check_refused(bake_mesh(mesh, options), BakeStatus::invalid_mesh, {"pose 1 of 2, position 7 has x = infinity"});
}

TEST_CASE("deformation: meshes without a triangle and meshes that are too far away are refused") {
    Mesh mesh = make_plane_grid(3);
    BakeOptions options = deforming();
    options.resolution = Resolution::step(-100);
    for (Vec3& p : mesh.positions) p = {0x1p40f, p.x * 0x1p-80f, p.y * 0x1p-80f};
    check_refused(bake_mesh(mesh, options), BakeStatus::too_fine, {"2^127 steps"});
    mesh.triangles.clear();
    mesh.materials.clear();
    check_refused(bake_mesh(mesh, deforming()), BakeStatus::invalid_mesh, {"no triangle"});
    check_refused(bake({}, deforming()), BakeStatus::invalid_mesh, {"no triangle"});
}

}  // namespace
}  // namespace espalier::tests::check_deformation_test
