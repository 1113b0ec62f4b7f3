// Moving scenes for tests, in memory of their own.
#pragma once

#include "support/testing.hpp"

namespace espalier::tests {

/// A moving scene with its memory, in which every byte is known at first.
class MadeScene {
public:
    MadeScene(std::uint32_t capacity, int step_exponent, std::span<const Blob> meshes,
              std::span<const BakedScene> tiles = {}, bool is_least = false)
        : memory_(units_of(is_least ? least_moving_scene_bytes(capacity) : moving_scene_bytes(capacity))) {
        scene = create_moving_scene(bytes(), capacity, step_exponent, meshes, tiles);
    }
    /// The scene of a snapshot; not open if the bytes are refused.
    MadeScene(std::span<const std::byte> snapshot, std::span<const Blob> meshes, std::span<const BakedScene> tiles = {})
        : memory_(units_of(snapshot.size())) {
        std::memcpy(memory_.data(), snapshot.data(), snapshot.size());
        scene = open_moving_scene(bytes().first(snapshot.size()), meshes, tiles);
    }
    MadeScene(const MadeScene&) = delete;
    MadeScene& operator=(const MadeScene&) = delete;
    ~MadeScene() = default;

    [[nodiscard]] std::span<std::byte> bytes() {
        return {reinterpret_cast<std::byte*>(memory_.data()), memory_.size() * sizeof(Unit)};
    }

private:
    struct alignas(32) Unit {
        std::byte bytes[32] = {};
    };
    static std::size_t units_of(std::uint64_t bytes) {
        return static_cast<std::size_t>((bytes + sizeof(Unit) - 1) / sizeof(Unit));
    }
    std::vector<Unit> memory_;

public:
    MovingScene scene;
};

}  // namespace espalier::tests
