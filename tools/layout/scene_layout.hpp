// Where things lie in a scene.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <espalier/scene.hpp>

namespace espalier::tools {

struct ScenePart {
    std::size_t at;
    std::size_t bytes;
};

/// The parts of an opened scene; the bytes between them are padding.
struct SceneLayout {
    ScenePart part_sizes;
    std::vector<ScenePart> parts;  ///< meshes, then tiles
    std::size_t mesh_count;
    ScenePart nodes;
    ScenePart instances;
    std::size_t padding;  ///< bytes in all

    /// Returns the bytes of all meshes that are not in tiles.
    [[nodiscard]] std::size_t mesh_bytes() const;
    /// Returns the bytes of all tiles.
    [[nodiscard]] std::size_t tile_bytes() const;
};

SceneLayout layout_of(std::span<const std::byte> bytes, const BakedScene& scene);

}  // namespace espalier::tools
