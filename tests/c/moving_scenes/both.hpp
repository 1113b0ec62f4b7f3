// A moving scene of C and one of C++, which get the same calls.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "c/comparing.hpp"

namespace espalier::tests {

/// Two empty moving scenes, each in memory of its own, that place the meshes and tiles of a baked scene.
class MovingSceneOfBoth {
public:
    MovingSceneOfBoth(const SceneOfBoth& baked, std::uint32_t capacity, int step_exponent)
        : memory_(moving_scene_bytes(capacity)), c_memory_(moving_scene_bytes(capacity)) {
        scene =
            create_moving_scene(memory_.bytes(), capacity, step_exponent, baked.scene.meshes(), baked.scene.tiles());
        std::size_t meshes = 0, tiles = 0;
        const espalier_blob* const c_meshes = espalier_scene_meshes(&baked.c_scene, &meshes);
        const espalier_scene* const c_tiles = espalier_scene_tiles(&baked.c_scene, &tiles);
        const std::span<std::byte> bytes = c_memory_.bytes();
        is_open = espalier_create_moving_scene(bytes.data(), bytes.size(), capacity, step_exponent, c_meshes, meshes,
                                               c_tiles, tiles, &c_scene);
    }
    /// Opens a snapshot on both sides.
    MovingSceneOfBoth(const SceneOfBoth& baked, std::span<const std::byte> snapshot)
        : memory_(snapshot.size()), c_memory_(snapshot.size()) {
        const std::span<std::byte> bytes = memory_.bytes(), c_bytes = c_memory_.bytes();
        std::memcpy(bytes.data(), snapshot.data(), bytes.size());
        std::memcpy(c_bytes.data(), snapshot.data(), c_bytes.size());
        scene = open_moving_scene(bytes, baked.scene.meshes(), baked.scene.tiles());
        std::size_t meshes = 0, tiles = 0;
        const espalier_blob* const c_meshes = espalier_scene_meshes(&baked.c_scene, &meshes);
        const espalier_scene* const c_tiles = espalier_scene_tiles(&baked.c_scene, &tiles);
        is_open =
            espalier_open_moving_scene(c_bytes.data(), c_bytes.size(), c_meshes, meshes, c_tiles, tiles, &c_scene);
    }
    MovingSceneOfBoth(const MovingSceneOfBoth&) = delete;
    MovingSceneOfBoth& operator=(const MovingSceneOfBoth&) = delete;
    ~MovingSceneOfBoth() = default;

    [[nodiscard]] bool are_blocks_equal() const {
        std::size_t size = 0;
        const void* const block = espalier_moving_scene_block(&c_scene, &size);
        if (size != scene.bytes().size()) return false;
        return size == 0 || std::memcmp(block, scene.bytes().data(), size) == 0;
    }

private:
    /// Memory of exactly so many bytes at an address that 32 divides, in which every byte is zero at first.
    class Memory {
    public:
        explicit Memory(std::uint64_t size) : room_(static_cast<std::size_t>(size) + 31), size_(size) {}
        [[nodiscard]] std::span<std::byte> bytes() {
            void* at = room_.data();
            std::size_t space = room_.size();
            const auto size = static_cast<std::size_t>(size_);
            return {static_cast<std::byte*>(std::align(32, size, at, space)), size};
        }

    private:
        std::vector<std::byte> room_;
        std::uint64_t size_;
    };
    Memory memory_, c_memory_;

public:
    MovingScene scene;
    espalier_moving_scene c_scene;
    bool is_open;  ///< as C returns it
};

}  // namespace espalier::tests
