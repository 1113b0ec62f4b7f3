// Bytes of moving scenes for tests that damage them, and edits that break a rule of a block.
#pragma once

#include "support/testing.hpp"

#include <functional>

#include <runtime/moving_scenes/box_tree/tree.hpp>

#include "made_scene.hpp"

namespace espalier::tests {

/// Two cubes, and a tile of them.
inline const SceneParts& cubes_and_tile() {
    static const SceneParts all({make_cube(-0.5f, 0.5f), make_cube(0.0f, 0.75f)}, {row_of(2, 1.5f)});
    return all;
}

inline Instance any_cube(Random& random) {
    return {
        .transform = {{random.signed_unit(), random.signed_unit(), random.signed_unit(), 1.0f}, random.in_cube(2.0f)},
        .mesh = random.below(3),
        .mask = 1u << random.below(3) | 1u << random.below(3)};
}

/// Returns a scene into which so many instances were inserted, and of which every third was removed again. One of the
/// others waits for a refit if that is asked for.
inline std::vector<std::byte> make_bytes(std::uint32_t capacity, std::uint32_t count, bool must_refit) {
    MadeScene made(capacity, -12, cubes_and_tile().meshes, cubes_and_tile().tiles);
    MovingScene& scene = made.scene;
    Random random(count);
    std::vector<Movement> movements;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (i == count / 2) repack(scene);
        movements.push_back({*insert(scene, any_cube(random)), any_cube(random).transform});
    }
    for (std::uint32_t i = 0; i < count; i += 3) (void)remove(scene, movements[i].instance);
    if (must_refit) (void)move(scene, std::span(movements).subspan(1, 1));
    return snapshot_of(scene);
}

inline MovingScene open_bytes(std::span<std::byte> bytes) {
    return open_moving_scene(bytes, cubes_and_tile().meshes, cubes_and_tile().tiles);
}

/// A copy of a scene's bytes, whose parts a test changes.
class EditedBlock {
public:
    explicit EditedBlock(std::span<const std::byte> bytes)
        : memory_(bytes), block(detail::parts_of(memory_.bytes().data())), head(*block.head) {}

    [[nodiscard]] bool opens() { return static_cast<bool>(open_bytes(memory_.bytes())); }

private:
    AlignedBuffer memory_;

public:
    detail::SceneBlock block;
    detail::BlockHead& head;
};

/// A rule and what breaks it.
struct Breach {
    std::string rule;
    std::function<void(EditedBlock&)> edit;
};

/// Checks that the bytes open, and that they do not after any of the edits.
inline void check_breaches(std::span<const std::byte> bytes, const std::vector<Breach>& breaches) {
    REQUIRE(EditedBlock(bytes).opens());
    for (const Breach& breach : breaches) {
        CAPTURE(breach.rule);
        EditedBlock edited(bytes);
        breach.edit(edited);
        CHECK_FALSE(edited.opens());
    }
}

/// A scene of three levels with free slots and free nodes; `must_refit` if one of its instances has been moved.
inline std::vector<std::byte> large_scene(bool must_refit = false) { return make_bytes(80, 78, must_refit); }

/// Returns the leaf node of the second slot, which is alive.
inline std::uint32_t leaf_of(const detail::SceneBlock& block) { return block.slots[1].place / 8; }

/// Takes a slot out of the tree, and renews the boxes above as if no node needed more children.
inline void drop_slot(detail::SceneBlock& block, std::uint32_t slot) {
    const std::uint32_t place = block.slots[slot].place;
    block.node(place / 8).drop(place % 8);
    detail::renew_ancestors(block, place / 8);
}

inline std::uint32_t last_free_node(const detail::SceneBlock& block) {
    std::uint32_t node = block.head->free_node;
    while (block.node(node).child[0] != detail::no_child) node = block.node(node).child[0];
    return node;
}

}  // namespace espalier::tests
