// After a refit, every query answers as the loop over the moved triangles does.
#include "support/testing.hpp"

#include "runtime/pairs/placement_check.hpp"
#include "support/answers/differences.hpp"
#include "support/answers/loop_answers.hpp"
#include "support/answers/path_answers.hpp"
#include "support/blobs/deformed_mesh.hpp"
#include "support/blobs/soundness.hpp"
#include "support/exercise/exercise.hpp"
#include "support/loops/triangle_loop.hpp"
#include "support/meshes/motions.hpp"
#include "support/queries/placement_maker.hpp"
#include "support/queries/shape_maker.hpp"
#include "support/queries/sweep_maker.hpp"

namespace espalier::tests::deformation_loop_test {
namespace {

constexpr unsigned every_precision[] = {8, 16, 17, 24};

std::vector<Mesh> meshes_that_move() {
    return {make_plane_grid(9), make_icosphere(2, 1.0, {3.0f, -1.0f, 2.0f}), make_torus(16, 8, 2.0, 0.5),
            make_soup(120, 4), make_needle_fan(60)};
}

/// Calls `check(mesh, motion, amount, seed)` for every mesh, precision and motion.
template <class Check>
void for_each_pose(Check check) {
    std::uint64_t seed = 3000;
    for (const Mesh& mesh : meshes_that_move())
        for (const unsigned bits : every_precision) {
            DeformedMesh moving(mesh, bits);
            CAPTURE(mesh.name);
            CAPTURE(bits);
            for (const Motion motion : every_motion) {
                const double amount = motion == Motion::collapse || seed % 2 == 0 ? 1.0 : 0.37;
                const std::string name = name_of(motion);
                CAPTURE(name);
                CAPTURE(amount);
                const std::vector<Vec3> positions = posed(mesh, motion, amount, seed);
                moving.move_to(positions);
                check(moving, positions, ++seed);
            }
        }
}

/// A mesh in its pose as the tests of pairs take it. The blob is that of the deformable mesh.
TestBlob test_blob_of(const DeformedMesh& moving) {
    TestBlob blob = {moving.mesh.name, OpenedBlob(moving.baked), moving.decoded()};
    blob.opened.blob = moving.deformable.blob();
    return blob;
}

TEST_CASE("deformation: triangles have the corners of the positions and every box holds what is below it") {
    for_each_pose([](const DeformedMesh& moving, const std::vector<Vec3>& positions, std::uint64_t) {
        const DecodedBlob decoded = moving.decoded();
        REQUIRE(decoded.triangles == moving.expected_triangles(positions));
        REQUIRE(is_sound(decoded));
    });
}

TEST_CASE("deformation: rays and segments equal the loop over the moved triangles") {
    std::uint64_t hits = 0;
    for_each_pose([&](const DeformedMesh& moving, const std::vector<Vec3>&, std::uint64_t seed) {
        const DecodedBlob decoded = moving.decoded();
        const TriangleLoop loop(decoded);
        QueryMaker maker(decoded, seed);
        for (std::uint64_t i = 0; i < scaled(24); ++i) {
            const Ray ray = maker.any_ray();
            require_none(ray_difference(moving.deformable.blob(), loop, ray, hits));
            const Segment segment = {ray.origin, maker.any_ray().origin};
            require_none(segment_difference(moving.deformable.blob(), loop, segment));
        }
    });
    if (asks_enough()) CHECK(hits > 2000);
}

TEST_CASE("deformation: spheres and closest points equal the loop over the moved triangles") {
    std::uint64_t hits = 0;
    for_each_pose([&](const DeformedMesh& moving, const std::vector<Vec3>&, std::uint64_t seed) {
        const DecodedBlob decoded = moving.decoded();
        const TriangleLoop loop(decoded);
        QueryMaker maker(decoded, seed);
        for (std::uint64_t i = 0; i < scaled(12); ++i) {
            require_none(sphere_difference(moving.deformable.blob(), loop,
                                           i % 2 == 0 ? maker.sphere() : maker.random_sphere(), hits));
        }
    });
    if (asks_enough()) CHECK(hits > 2000);
}

TEST_CASE("deformation: volumes and distances and sweeps equal the loop over the moved triangles") {
    for_each_pose([](const DeformedMesh& moving, const std::vector<Vec3>&, std::uint64_t seed) {
        const DecodedBlob decoded = moving.decoded();
        const TriangleLoop loop(decoded);
        ShapeMaker shapes(decoded, seed);
        SweepMaker sweeps(decoded, seed + 1);
        for (std::uint64_t i = 0; i < scaled(6); ++i) {
            require_none(loop_difference(moving.deformable.blob(), loop, shapes, sweeps));
        }
    });
}

TEST_CASE("deformation: every instruction set gives the same answers in a pose") {
    for_each_pose([](const DeformedMesh& moving, const std::vector<Vec3>&, std::uint64_t seed) {
        Random random(seed);
        for (std::uint64_t i = 0; i < scaled(4); ++i) {
            require_none(path_difference(moving.deformable.blob(), random, true));
        }
    });
}

TEST_CASE("deformation: every query answers within its promises in every pose") {
    for_each_pose([](const DeformedMesh& moving, const std::vector<Vec3>&, std::uint64_t seed) {
        Random random(seed);
        REQUIRE_NOTHROW(exercise(moving.deformable.blob(), random, static_cast<unsigned>(scaled(2))));
    });
}

TEST_CASE("deformation: pairs of moved meshes equal the loop over all pairs of triangles") {
    PlacementCounts counts;
    std::uint64_t seed = 3500;
    const std::vector<Mesh> meshes = meshes_that_move();
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        DeformedMesh a(meshes[i], every_precision[i % 4]);
        DeformedMesh b(meshes[(i + 1) % meshes.size()], every_precision[(i + 1) % 4]);
        for (const Motion motion : every_motion) {
            const std::string name = name_of(motion);
            CAPTURE(a.mesh.name);
            CAPTURE(name);
            a.move_to(posed(a.mesh, motion));
            b.move_to(posed(b.mesh, seed % 2 == 0 ? motion : Motion::twist, 0.5));
            const TestBlob first = test_blob_of(a), second = test_blob_of(b);
            const PairedBlob first_pair(first), second_pair(second);
            PlacementMaker maker(first.decoded, second.decoded, ++seed);
            for (std::uint64_t n = 0; n < scaled(4); ++n)
                check_placement(first_pair, second_pair, n % 2 == 0 ? maker.random() : maker.adversarial(),
                                {.distances = n % 4 == 0}, counts);
        }
    }
    CHECK(counts.touching > 0);
}

}  // namespace
}  // namespace espalier::tests::deformation_loop_test
