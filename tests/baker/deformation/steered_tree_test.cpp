// Poses steer the tree: the one that is kept costs least over all of them.
#include "support/testing.hpp"

#include "baker/baking_support.hpp"
#include "support/blobs/deformed_mesh.hpp"
#include "support/meshes/motions.hpp"

namespace espalier::tests::steered_tree_test {
namespace {

TEST_CASE("deformation: a tree that poses steered costs less in them") {
    // At rest, neighbours are far apart in the pose.
    const Mesh mesh = make_soup(400, 11);
    std::vector<Vec3> shuffled(mesh.positions.size());
    for (std::size_t i = 0; i + 2 < shuffled.size(); i += 3) {
        const std::size_t other = (i / 3 * 7 % (shuffled.size() / 3)) * 3;
        for (std::size_t c = 0; c < 3; ++c) {
            const Vec3 &from = mesh.positions[other], &at = mesh.positions[i], &p = mesh.positions[i + c];
            shuffled[i + c] = {from.x + p.x - at.x, from.y + p.y - at.y, from.z + p.z - at.z};
        }
    }
    BakeOptions options = {.profile = Profile::fast};
    options.deformation.emplace();
    options.deformation->range = box_around({mesh.positions, shuffled});
    DeformedMesh plain(mesh, options);
    // Three times as much counts for the pose.
    options.deformation->poses = {shuffled, shuffled, shuffled};
    DeformedMesh steered(mesh, options);
    const float plain_growth = plain.move_to(shuffled);
    const float steered_growth = steered.move_to(shuffled);
    CHECK(plain_growth > 1.5f);
    CHECK(steered_growth < 1.0f);
}

TEST_CASE("deformation: a tree over mesh and pose costs less in the pose than one for the mesh") {
    // Folded, each triangle has neighbours from both halves.
    const Mesh mesh = make_plane_grid(40);
    const std::vector<Vec3> folded = posed(mesh, Motion::fold);
    BakeOptions options = deformable_options(mesh);
    DeformedMesh plain(mesh, options);
    options.deformation->poses = {folded};
    DeformedMesh steered(mesh, options);
    CHECK(steered.move_to(folded) < 0.8f * plain.move_to(folded));
}

TEST_CASE("deformation: poses in which many triangles coincide give sound blobs of limited depth") {
    Mesh chain;  // each triangle twice as far away as the one before
    for (int i = 0; i < 120; ++i) {
        const float at = std::ldexp(1.0f, i % 24);
        append_triangle(chain, {at, 0.0f, 0.0f}, {at, 0.3f * at, 0.3f}, {at, 0.6f * at, 0.6f});
    }
    for (const Mesh& mesh : {make_soup(200, 3), chain, make_coplanar_stacks(150, 2)}) {
        BakeOptions options = deformable_options(mesh, 24);
        options.deformation->poses = every_pose(mesh);
        DeformedMesh moving(mesh, options);
        CHECK(moving.still.depth() <= format::max_depth);
        require_sound(moving.baked);
    }
}

}  // namespace
}  // namespace espalier::tests::steered_tree_test
