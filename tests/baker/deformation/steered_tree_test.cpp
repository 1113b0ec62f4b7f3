// Poses steer the tree: the one that is kept costs least over all of them.
#include <doctest/doctest.h>

#include <vector>

#include <espalier/bake.hpp>
#include <espalier/ray.hpp>

#include "support/base/same_bits.hpp"
#include "support/blobs/deformed_mesh.hpp"
#include "support/meshes/makers.hpp"
#include "support/meshes/motions.hpp"

using namespace espalier;
using namespace espalier::tests;

TEST_SUITE("steered tree") {
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
        BakeOptions options;
        options.profile = Profile::fast;
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

    TEST_CASE("deformation: poses that fit the tree at rest leave the blob as it is") {
        const Mesh mesh = make_plane_grid(8);
        BakeOptions options;
        options.profile = Profile::fast;
        options.deformation.emplace();
        options.deformation->range = box_around(every_pose(mesh));
        const DeformedMesh plain(mesh, options);
        options.deformation->poses = {mesh.positions};
        CHECK(DeformedMesh(mesh, options).baked == plain.baked);
    }
}
