// Tests that no argument of c/scenes does harm, and that hostile ones get the bits of C++.
// Worth most under sanitizers.
#include <doctest/doctest.h>

#include <cstddef>
#include <vector>

#include "c/moving_scenes/both.hpp"
#include "support/base/test_scale.hpp"

using namespace espalier;
using namespace espalier::tests;

TEST_SUITE("hostile") {
    TEST_CASE("c api: any bits are safe as a question about a moving scene") {
        const std::vector<std::byte> bytes = bake_instances(some_instances());
        const SceneOfBoth baked(bytes);
        const espalier_scene c_empty = {};
        const BakedScene empty;
        Random random(23);
        for (const int step_exponent : {-100, -30, -16, 80}) {
            MovingSceneOfBoth both(baked, 12, step_exponent);
            REQUIRE(both.is_open);
            for (std::uint64_t i = 0; i < scaled(200); ++i) {
                const auto asked = any_bits<question>(random);
                compare_moving_scenes(both.c_scene, baked.c_scene, both.scene, baked.scene, asked);
                compare_moving_scenes(both.c_scene, c_empty, both.scene, empty, asked);
                REQUIRE(both.are_blocks_equal());
            }
        }
    }

    TEST_CASE("c api: a damaged snapshot opens as in C++ and gives the same bits") {
        const std::vector<std::byte> bytes = bake_instances(some_instances());
        const SceneOfBoth baked(bytes);
        MovingSceneOfBoth whole(baked, 12, -16);
        for (const Instance& instance : some_instances())
            if (whole.scene.instance_count() < 9) CHECK(insert(whole.scene, instance));
        const std::vector<std::byte> snapshot(whole.scene.bytes().begin(), whole.scene.bytes().end());
        Random random(24);
        std::uint64_t opened = 0;
        const std::uint64_t rounds = scaled(1'000);
        for (std::uint64_t i = 0; i < rounds; ++i) {
            std::vector<std::byte> damaged = snapshot;
            const auto size = static_cast<std::uint32_t>(damaged.size());
            for (std::uint32_t changes = random.below(3); changes > 0; --changes)
                damaged[random.below(random.coin() ? 64 : size)] ^= static_cast<std::byte>(1 + random.below(255));
            if (random.below(8) == 0) damaged.resize(random.below(size));
            MovingSceneOfBoth both(baked, damaged);
            REQUIRE(both.is_open == static_cast<bool>(both.scene));
            opened += both.is_open ? 1u : 0u;
            compare_moving_scenes(both.c_scene, baked.c_scene, both.scene, baked.scene,
                                  some_question(baked.scene, random));
            REQUIRE(both.are_blocks_equal());
        }
        CHECK(opened > 0);
        CHECK(opened < rounds);
    }
}
