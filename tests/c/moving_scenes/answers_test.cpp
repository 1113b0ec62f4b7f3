// Claims about c/scenes: changed and queried from C, a moving scene answers what it answers C++.
#include <doctest/doctest.h>

#include <array>
#include <cstring>
#include <vector>

#include "c/moving_scenes/both.hpp"
#include "support/base/test_scale.hpp"

using namespace espalier;
using namespace espalier::tests;

TEST_SUITE("answers") {
    TEST_CASE("c api: changes and queries and pairs of a moving scene give the bits of C++") {
        const std::vector<std::byte> bytes = bake_instances(some_instances());
        const SceneOfBoth baked(bytes);
        MovingSceneOfBoth both(baked, 20, -16);
        REQUIRE(both.scene);
        REQUIRE(both.is_open);
        REQUIRE(both.are_blocks_equal());
        const std::vector<Instance> instances = some_instances();
        for (std::size_t i = 0; i < 12; ++i) {
            espalier_instance instance;
            std::memcpy(&instance, &instances[i], sizeof instance);
            REQUIRE(espalier_moving_scene_insert(&both.c_scene, &instance).status == ESPALIER_QUERY_OK);
            REQUIRE(insert(both.scene, instances[i]));
        }
        Random random(21);
        std::uint64_t hits = 0, pairs = 0, collisions = 0, refusals = 0, full = 0;
        const std::uint64_t rounds = scaled(200);
        for (std::uint64_t i = 0; i < rounds; ++i) {
            const question asked = some_question(baked.scene, random);
            compare_moving_scenes(both.c_scene, baked.c_scene, both.scene, baked.scene, asked);
            REQUIRE(both.are_blocks_equal());
            const InScene<ClosestPoint> nearest = closest_point(both.scene, {0.0f, 1.0f, 2.0f});
            hits += nearest ? 1u : 0u;
            refusals += nearest->status == QueryStatus::not_refitted ? 1u : 0u;
            std::array<InstancePair, 9> page;
            std::array<espalier_instance_pair, 9> c_page;  // filled too, so that both blocks get the same calls
            const std::uint64_t limit = ESPALIER_WORK_UNLIMITED;
            pairs += collect_candidate_pairs(both.scene, page).count;
            pairs += espalier_collect_candidate_pairs(&both.c_scene, c_page.data(), 9, nullptr, {0, 0}).count;
            collisions += collect_colliding_pairs(both.scene, page, WorkLimit(limit)).count;
            collisions +=
                espalier_collect_colliding_pairs(&both.c_scene, c_page.data(), 9, limit, nullptr, {0, 0}).count;
            full += both.scene.instance_count() + 1 >= both.scene.capacity() ? 1u : 0u;
        }
        if (!asks_enough()) return;
        CHECK(hits > rounds / 2);
        CHECK(refusals > rounds / 64);
        CHECK(pairs > 2 * rounds);
        CHECK(collisions > 2 * rounds);
        CHECK(full > rounds / 4);
    }

    TEST_CASE("c api: a moving scene filled with zeros is one that is not open") {
        espalier_moving_scene zero;
        std::memset(&zero, 0, sizeof zero);
        static MovingScene empty;  // static, so that what lies between its fields is zero too
        CHECK(std::memcmp(&zero, static_cast<const void*>(&empty), sizeof zero) == 0);
        const std::vector<std::byte> bytes = bake_instances(some_instances());
        const SceneOfBoth baked(bytes);
        Random random(22);
        for (std::uint64_t i = 0; i < scaled(20); ++i) {
            const question asked = some_question(baked.scene, random);
            compare_moving_scenes(zero, baked.c_scene, empty, baked.scene, asked);
        }
    }

    TEST_CASE("c api: a moving scene is created and opened and viewed as its header states") {
        const std::vector<std::byte> bytes = bake_instances(some_instances());
        const SceneOfBoth baked(bytes);
        CHECK(misbehaviour_of_moving_scenes(&baked.c_scene) == 0);
    }
}
