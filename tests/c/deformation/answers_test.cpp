// Claims about deformation.h: refitted and queried from C, a deformable mesh answers what it answers C++.
#include <doctest/doctest.h>

#include <vector>

#include "c/deformation/both.hpp"
#include "support/base/profiles.hpp"
#include "support/base/test_scale.hpp"

using namespace espalier;
using namespace espalier::tests;

TEST_SUITE("answers") {
    TEST_CASE("c api: refits and queries of a deformable mesh give the bits of C++") {
        Random random(31);
        for (const unsigned bits : {8u, 16u, 21u})
            for (const Mesh& mesh : {make_torus(12, 8, 2.0, 0.5), make_soup(60, 1), make_terrain(6, 2)}) {
                const MeshInPoses deformed(mesh, bits);
                DeformableOfBoth both(deformed.bytes);
                REQUIRE(both.c_open_status == ESPALIER_OPEN_OK);
                REQUIRE(both.c_status == ESPALIER_QUERY_OK);
                REQUIRE(both.mesh);
                REQUIRE(both.are_memories_equal());
                const Blob& blob = both.mesh.blob();
                const espalier_blob c_blob = *espalier_deformable_blob(&both.c_mesh);  // stays valid
                for (const std::vector<Vec3>& pose : deformed.poses) {
                    compare_refits(both.c_mesh, both.mesh, pose, some_question(blob, random));
                    REQUIRE(both.are_memories_equal());
                    for (std::uint64_t i = 0; i < scaled(3); ++i) {
                        const question asked = some_question(blob, random);
                        compare_all(c_blob, both.c_blob, blob, both.blob, asked);
                    }
                    const std::vector<std::byte> sealed = both.sealed();
                    REQUIRE(open(sealed));
                    if (&pose == &deformed.poses.back()) CHECK(sealed == deformed.bytes);
                }
            }
    }

    TEST_CASE("c api: a deformable mesh filled with zeros is one that is not open") {
        espalier_deformable zero = {};
        Deformable empty;
        Random random(32);
        const OpenedBlob opened = blob_with_everything(Profile::fast);
        const espalier_blob c_opened = open_from_c(opened.bytes);
        const std::vector<Vec3> positions(9);
        for (std::uint64_t i = 0; i < scaled(20); ++i) {
            const question asked = some_question(opened.blob, random);
            compare_refits(zero, empty, positions, asked);
            compare_all(*espalier_deformable_blob(&zero), c_opened, empty.blob(), opened.blob, asked);
        }
    }

    TEST_CASE("c api: a deformable mesh is created and refitted and sealed as its header states") {
        const MeshInPoses deformed(make_torus(12, 8, 2.0, 0.5), 16);
        const std::vector<espalier_vec3> rest = in_c(deformed.mesh.positions), pose = in_c(stretched(deformed.mesh));
        const OpenedBlob rigid = blob_with_everything(Profile::fast);
        const espalier_blob c_rigid = open_from_c(rigid.bytes);
        const deformable_blob blob = {deformed.bytes.data(),
                                      deformed.bytes.size(),
                                      rest.data(),
                                      pose.data(),
                                      static_cast<std::uint32_t>(rest.size()),
                                      &c_rigid};
        CHECK(misbehaviour_of_deformables(&blob) == 0);
        CHECK(misbehaviour_of_deformables_in_scenes(&blob) == 0);
    }
}
