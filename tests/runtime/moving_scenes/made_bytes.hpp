// Bytes of moving scenes for tests that damage them.
#pragma once

#include "support/testing.hpp"

#include <runtime/moving_scenes/box_tree/block.hpp>

#include "made_scene.hpp"
#include "runtime/scenes/maker.hpp"
#include "support/machine/aligned_buffer.hpp"

namespace espalier::tests {

/// Two cubes, and a tile of them.
struct CubesAndTile {
    std::vector<OpenedBlob> opened;
    std::vector<OpenedScene> opened_tiles;
    std::vector<Blob> meshes;
    std::vector<BakedScene> tiles;

    CubesAndTile() {
        opened.emplace_back(make_cube(-0.5f, 0.5f));
        opened.emplace_back(make_cube(0.0f, 0.75f));
        for (const OpenedBlob& blob : opened) meshes.push_back(blob.blob);
        std::vector<Instance> row(2);
        row[1].transform.translation.x = 1.5f;
        opened_tiles.emplace_back(opened, row);
        for (const OpenedScene& tile : opened_tiles) tiles.push_back(tile.scene);
    }
};
inline const CubesAndTile& cubes_and_tile() {
    static const CubesAndTile all;
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
    return {scene.bytes().begin(), scene.bytes().end()};
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

}  // namespace espalier::tests
