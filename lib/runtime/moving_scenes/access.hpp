// The block, meshes and tiles behind a MovingScene.
#pragma once

#include <espalier/scenes/moving_scene.hpp>
#include <runtime/moving_scenes/box_tree/block.hpp>
#include <runtime/moving_scenes/seen.hpp>
#include <runtime/scenes/instances.hpp>

namespace espalier::detail {

/// The only way to the private parts of a MovingScene.
class MovingSceneAccess {
public:
    static MovingScene make(std::byte* block, std::span<const Blob> meshes, std::span<const BakedScene> tiles) {
        MovingScene scene;
        scene.block_ = block;
        scene.meshes_ = meshes.data();
        scene.tiles_ = tiles.data();
        scene.mesh_count_ = static_cast<std::uint32_t>(meshes.size());
        scene.tile_count_ = static_cast<std::uint32_t>(tiles.size());
        return scene;
    }
    /// Returns the origin of the view, in steps.
    static const std::int32_t (&origin(const MovingScene& scene))[3] { return scene.origin_; }
    static MovingScene with_origin(MovingScene scene, const std::int32_t (&steps)[3]) {
        for (int k = 0; k < 3; ++k) scene.origin_[k] = steps[k];
        return scene;
    }
    static SceneBlock block(const MovingScene& scene) { return parts_of(scene.block_); }
    static const BlockHead& head(const MovingScene& scene) {
        return *static_cast<const BlockHead*>(static_cast<const void*>(scene.block_));
    }
};

inline SceneBlock block_of(const MovingScene& scene) { return MovingSceneAccess::block(scene); }

/// Returns ok for an open scene whose boxes are those of its instances.
inline QueryStatus readiness_of(const MovingScene& scene) {
    if (!scene) return QueryStatus::not_open;
    return MovingSceneAccess::head(scene).must_refit != 0 ? QueryStatus::not_refitted : QueryStatus::ok;
}

/// Returns whether a number is that of a mesh with triangles, or of a tile with instances and without tiles.
inline bool is_placeable(const MovingScene& scene, std::uint32_t mesh) {
    const std::size_t meshes = scene.meshes().size();
    if (mesh < meshes) return scene.meshes()[mesh].triangle_count() != 0;
    if (mesh - meshes >= scene.tiles().size()) return false;
    const BakedScene& tile = scene.tiles()[mesh - meshes];
    return tile.instance_count() != 0 && tile.tiles().empty();
}
/// Returns the mesh or the tile of a placeable number.
inline MeshOrTile part_of(const MovingScene& scene, std::uint32_t mesh) {
    const std::size_t meshes = scene.meshes().size();
    if (mesh < meshes) return {&scene.meshes()[mesh], nullptr};
    return {nullptr, &scene.tiles()[mesh - meshes]};
}
/// Returns the bounds of a placeable mesh or tile.
inline PartBounds bounds_of_part(const MovingScene& scene, std::uint32_t mesh) {
    const MeshOrTile part = part_of(scene, mesh);
    return part.mesh != nullptr ? bounds_of(data_of(*part.mesh)) : bounds_of(*part.tile);
}

/// Returns the slot of a handle, or null if it is stale or was never returned.
inline InstanceSlot* find_slot(const SceneBlock& block, InstanceHandle handle) {
    if (handle.slot >= block.head->slots_used) return nullptr;
    InstanceSlot& slot = block.slots[handle.slot];
    return is_live(slot) && slot.generation == handle.generation ? &slot : nullptr;
}

/// Returns the transform of an instance, seen from the origin of the view.
inline Transform seen_transform(const MovingScene& scene, const InstanceSlot& slot) {
    return seen_transform(slot, MovingSceneAccess::origin(scene), MovingSceneAccess::head(scene).step_exponent);
}
/// Returns the box of an instance, seen from the origin of the view, rounded outward to float.
Box box_in_view(const MovingScene& scene, const StepsBox& box);

}  // namespace espalier::detail
