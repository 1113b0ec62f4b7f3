// Tests that no argument of deformation.h does harm, and that hostile ones get the bits of C++.
#include <doctest/doctest.h>

#include <vector>

#include "c/deformation/both.hpp"
#include "c/expecting.hpp"
#include "support/base/checksum.hpp"
#include "support/base/test_scale.hpp"
#include "support/machine/exact_buffer.hpp"
#include "support/queries/hostile_arguments.hpp"

using namespace espalier;
using namespace espalier::tests;

TEST_SUITE("hostile") {
    TEST_CASE("c api: any bits are safe as positions and a refused refit changes nothing") {
        const MeshInPoses deformed(make_torus(12, 8, 2.0, 0.5), 16);
        DeformableOfBoth both(deformed.bytes);
        REQUIRE(both.c_status == ESPALIER_QUERY_OK);
        Random random(33);
        std::vector<std::byte> before = both.sealed();
        std::uint64_t refits = 0;
        const std::uint64_t rounds = scaled(500);
        for (std::uint64_t i = 0; i < rounds; ++i) {
            std::vector<Vec3> positions = deformed.poses[random.below(8)];
            for (std::uint32_t changes = random.below(4); changes > 0; --changes) {
                Vec3& position = positions[random.below(static_cast<std::uint32_t>(positions.size()))];
                position = random.coin() ? cpp(any_bits<espalier_vec3>(random)) : some_point(both.blob, random);
            }
            if (random.below(16) == 0) positions.resize(random.below(200));
            compare_refits(both.c_mesh, both.mesh, positions, some_question(both.blob, random));
            REQUIRE(both.are_memories_equal());
            const bool is_refitted = static_cast<bool>(refit(both.mesh, positions));  // to the same once more
            refits += is_refitted ? 1u : 0u;
            std::vector<std::byte> after = both.sealed();
            REQUIRE_FALSE(after.empty());
            if (!is_refitted) REQUIRE(after == before);
            before = std::move(after);
            if (random.below(8) == 0)
                compare_all(*espalier_deformable_blob(&both.c_mesh), both.c_blob, both.mesh.blob(), both.blob,
                            any_bits<question>(random));
        }
        if (asks_enough()) CHECK(refits > rounds / 8);
        CHECK(refits < rounds);
    }

    TEST_CASE("c api: a damaged deformable blob opens as in C++ and gives the same bits") {
        const MeshInPoses deformed(make_soup(60, 1), 16);
        const OpenedBlob good(std::vector<std::byte>(deformed.bytes));
        Random random(34);
        std::uint64_t opened = 0, refits = 0;
        const std::uint64_t rounds = scaled(1'000);
        for (std::uint64_t i = 0; i < rounds; ++i) {
            ExactBuffer buffer(deformed.bytes, random.below(16));
            const auto size = static_cast<std::uint32_t>(buffer.bytes().size());
            for (std::uint32_t changes = 1 + random.below(3); changes > 0; --changes)
                buffer.bytes()[random.below(random.coin() ? 128 : size)] ^=
                    static_cast<std::byte>(1 + random.below(255));
            repair_checksum(buffer.bytes());
            DeformableOfBoth both(buffer.bytes());
            REQUIRE(both.c_open_status == static_cast<espalier_open_status>(both.blob.status()));
            REQUIRE(both.c_status == static_cast<espalier_query_status>(both.mesh.status()));
            opened += both.mesh ? 1u : 0u;
            std::vector<Vec3> positions = deformed.poses[random.below(8)];
            if (random.coin()) positions.resize(both.mesh.position_count() % 10'000);
            compare_refits(both.c_mesh, both.mesh, positions, some_question(good.blob, random));
            REQUIRE(both.are_memories_equal());
            refits += refit(both.mesh, positions) ? 1u : 0u;  // to the same once more
            compare_all(*espalier_deformable_blob(&both.c_mesh), both.c_blob, both.mesh.blob(), both.blob,
                        some_question(good.blob, random));
        }
        CHECK(opened > 0);
        CHECK(opened < rounds);
        if (asks_enough()) CHECK(refits > 0);
    }
}
