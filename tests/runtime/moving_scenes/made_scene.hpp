// Moving scenes for tests, in memory of their own, and what they are made of.
#pragma once

#include "support/testing.hpp"

#include "runtime/scenes/maker.hpp"
#include "support/machine/aligned_buffer.hpp"

namespace espalier::tests {

/// A moving scene with its memory, in which every byte is known at first.
class MadeScene {
public:
    MadeScene(std::uint32_t capacity, int step_exponent, std::span<const Blob> meshes,
              std::span<const BakedScene> tiles = {}, bool is_least = false)
        : memory_(
              static_cast<std::size_t>(is_least ? least_moving_scene_bytes(capacity) : moving_scene_bytes(capacity))),
          scene(create_moving_scene(bytes(), capacity, step_exponent, meshes, tiles)) {}
    /// The scene of a snapshot; not open if the bytes are refused.
    MadeScene(std::span<const std::byte> snapshot, std::span<const Blob> meshes, std::span<const BakedScene> tiles = {})
        : memory_(snapshot), scene(open_moving_scene(bytes(), meshes, tiles)) {}

    [[nodiscard]] std::span<std::byte> bytes() { return memory_.bytes(); }

private:
    AlignedBuffer memory_;

public:
    MovingScene scene;
};

inline Bytes snapshot_of(const MovingScene& scene) { return {scene.bytes().begin(), scene.bytes().end()}; }

/// Meshes, and tiles of their instances.
struct SceneParts {
    explicit SceneParts(const std::vector<Mesh>& made, const std::vector<std::vector<Instance>>& made_tiles = {})
        : opened(opened_blobs(made)) {
        for (const OpenedBlob& blob : opened) meshes.push_back(blob.blob);
        for (const std::vector<Instance>& instances : made_tiles) opened_tiles.emplace_back(opened, instances);
        for (const OpenedScene& tile : opened_tiles) tiles.push_back(tile.scene);
    }
    std::vector<OpenedBlob> opened;
    std::vector<OpenedScene> opened_tiles;
    std::vector<Blob> meshes;
    std::vector<BakedScene> tiles;
};

/// Instances of the first mesh so far apart along x.
inline std::vector<Instance> row_of(std::size_t count, float apart) {
    std::vector<Instance> row(count);
    for (std::size_t i = 0; i < count; ++i) row[i].transform.translation.x = apart * static_cast<float>(i);
    return row;
}

/// Returns a place with any rotation, a scale from 1/64 to 16, and a translation of up to 2^14.
inline Transform random_place(Random& random) {
    return {{random.signed_unit(), random.signed_unit(), random.signed_unit(), random.signed_unit()},
            random.in_cube(std::ldexp(1.0f, random.between(-4, 14))),
            std::ldexp(1.0f + random.unit(), random.between(-6, 3))};
}

inline bool share_a_point(const Box& a, const Box& b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y && a.min.z <= b.max.z &&
           b.min.z <= a.max.z;
}

/// Returns the list that pages make, one behind the other. `collect(page, from)` is the query.
template <class Pair, class Collect>
std::vector<Pair> in_pages(std::size_t size, Collect collect) {
    std::vector<Pair> all, page(size);
    Pair from;
    for (int i = 0; i < 100'000; ++i) {
        const FilledPairs<Pair> found = collect(std::span<Pair>(page), from);
        REQUIRE(found.count <= size);
        all.insert(all.end(), page.begin(), page.begin() + static_cast<std::ptrdiff_t>(found.count));
        if (found.status == QueryStatus::ok) return all;
        REQUIRE((found.status == QueryStatus::output_full || found.status == QueryStatus::work_limit));
        REQUIRE(found.next > from);
        from = found.next;
    }
    return {};
}

}  // namespace espalier::tests
