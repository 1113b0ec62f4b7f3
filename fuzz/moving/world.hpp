// What the instances of the fuzzed moving scenes place, and a baked scene in the same world.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <espalier/scene.hpp>

#include "support/blobs/baking.hpp"

namespace espalier::fuzz {

/// Meshes of about the size 1, one of them empty, and tiles of them: a row, an empty one, and one that holds a tile.
/// The last and the empty ones cannot be placed in a moving scene.
class World {
public:
    World();

    [[nodiscard]] const std::vector<Blob>& meshes() const { return meshes_; }
    [[nodiscard]] const std::vector<BakedScene>& tiles() const { return tiles_; }
    /// A scene with a tile, whose instances lie around the origin.
    [[nodiscard]] const BakedScene& baked() const { return tiles_.back(); }

    /// Returns whether insert() takes the number of a mesh or tile.
    [[nodiscard]] bool is_placeable(std::uint32_t mesh) const;
    /// Returns the box of a mesh or tile that can be placed.
    [[nodiscard]] Box bounds_of(std::uint32_t mesh) const;
    /// Returns the vertices of a mesh or tile that can be placed, three for each triangle, in its local space.
    [[nodiscard]] const std::vector<Vec3>& vertices_of(std::uint32_t mesh) const { return vertices_[mesh]; }

private:
    struct Scene {
        std::vector<std::byte> bytes;
        std::vector<Blob> meshes;
        std::vector<BakedScene> tiles;
    };
    void add_tile(const std::vector<Instance>& instances);

    std::vector<tests::OpenedBlob> opened_;
    std::vector<Scene> scenes_;
    std::vector<Blob> meshes_;
    std::vector<BakedScene> tiles_;
    std::vector<std::vector<Vec3>> vertices_;
};

const World& world();

}  // namespace espalier::fuzz
