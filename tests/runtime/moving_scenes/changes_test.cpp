// Claims about changes of a moving scene that only its bytes or many steps reveal.
#include "support/testing.hpp"

#include <runtime/moving_scenes/access.hpp>

#include "made_bytes.hpp"

namespace espalier::tests::changes_test {
namespace {

/// Returns how many pairs have an instance that has moved in this step.
std::size_t moved_pairs(MovingScene& scene) {
    std::vector<InstancePair> page(100);
    return collect_candidate_pairs(scene, page, {true, {}}).count;
}

TEST_CASE("scene: a refused move of a moving scene that waits for a refit changes nothing") {
    MadeScene made(20, -12, cubes_and_tile().meshes);
    MovingScene& scene = made.scene;
    std::vector<Movement> movements;
    for (int i = 0; i < 20; ++i) {
        const Transform transform = {{}, {static_cast<float>(2 * i), 0.0f, 0.0f}, 1.0f};
        movements.push_back({*insert(scene, {transform}), transform});
        movements.back().transform.translation.y = 100.0f;
    }
    REQUIRE(move(scene, movements).count == 20);
    const std::vector<std::byte> before = snapshot_of(scene);
    for (const Movement& movement : movements)
        CHECK(move(scene, movement.instance, {{}, {}, -1.0f}) == QueryStatus::invalid_argument);
    CHECK(snapshot_of(scene) == before);
    CHECK(move(scene, movements[0].instance, movements[0].transform) == QueryStatus::ok);
    CHECK(snapshot_of(scene) != before);
}

TEST_CASE("scene: quality is one after a repack of instances that are smaller than a step") {
    MadeScene made(3, 8, cubes_and_tile().meshes);
    for (int i = 0; i < 3; ++i) {
        REQUIRE(insert(made.scene, {}));
        repack(made.scene);
        CHECK(quality(made.scene) == 1.0f);
    }
}

TEST_CASE("scene: after 2^32 steps of a moving scene no instance counts as moved and the next one is step one") {
    for (const std::uint32_t capacity : {3u, 4u}) {
        CAPTURE(capacity);
        MadeScene made(capacity, -12, cubes_and_tile().meshes);
        MovingScene& scene = made.scene;
        detail::SceneBlock block = detail::block_of(scene);
        REQUIRE(insert(scene, {}));
        REQUIRE(insert(scene, {}));
        CHECK(moved_pairs(scene) == 1);
        end_step(scene);
        CHECK(block.head->step == 2);
        CHECK(moved_pairs(scene) == 0);
        block.head->step = 0xFFFFFFFF;
        REQUIRE(insert(scene, {}));
        CHECK(moved_pairs(scene) == 2);
        // What lies behind the slots in use stays as it is.
        (capacity == 3 ? block.counts[0] : block.moved[3]) = 7;
        end_step(scene);
        CHECK((capacity == 3 ? block.counts[0] : block.moved[3]) == 7);
        CHECK(block.head->step == 1);
        CHECK(moved_pairs(scene) == 0);
        end_step(scene);
        CHECK(block.head->step == 2);
    }
}

}  // namespace
}  // namespace espalier::tests::changes_test
