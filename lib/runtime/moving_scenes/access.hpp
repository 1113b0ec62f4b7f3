// The block, meshes and tiles behind a MovingScene, and its instances as they are seen from an origin in a world that
// float32 does not resolve.
#pragma once

#include <espalier/scenes/moving_scene.hpp>
#include <runtime/moving_scenes/box_tree/block.hpp>
#include <runtime/scenes/instances.hpp>

namespace espalier::detail {

/// Origins are multiples of it, in steps: the difference of two has 24 bits, and is exact as a float.
inline constexpr std::int32_t origin_grid = 128;

constexpr bool are_equal(const std::int32_t (&a)[3], const std::int32_t (&b)[3]) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/// Returns the transform of an instance, seen from an origin. The translation is rounded once, and not at
/// all if the instance was placed through the same origin.
inline Transform seen_transform(const InstanceSlot& slot, const std::int32_t (&origin)[3], std::int32_t step_exponent) {
    Transform seen = slot.transform;
    if (are_equal(slot.origin, origin)) return seen;
    const float step = power_of_two(step_exponent);
    float* const translation[3] = {&seen.translation.x, &seen.translation.y, &seen.translation.z};
    for (int k = 0; k < 3; ++k)  // the sum with 0 would change zeros with a sign, and subnormal numbers in some modes
        if (slot.origin[k] != origin[k]) *translation[k] += static_cast<float>(slot.origin[k] - origin[k]) * step;
    return seen;
}

/// Returns whether the translation as it is seen from there differs from the one that was given. The instance may then
/// be a step of the lattice away from its neighbours.
inline bool is_rounded_in(const InstanceSlot& slot, const std::int32_t (&origin)[3], std::int32_t step_exponent) {
    const float step = power_of_two(step_exponent);
    const float given[3] = {slot.transform.translation.x, slot.transform.translation.y, slot.transform.translation.z};
    for (int k = 0; k < 3; ++k) {
        if (slot.origin[k] == origin[k]) continue;
        // The sum is exact if it gives back both of its parts (Knuth 1969). Numbers below 2^-100 are apart: what a sum
        // loses of them may be subnormal.
        if (magnitude_bits(given[k]) != 0 && magnitude_bits(given[k]) < magnitude_bits(0x1p-100f)) return true;
        const float way = static_cast<float>(slot.origin[k] - origin[k]) * step, seen = given[k] + way;
        const float added = seen - given[k];
        if (way != added || given[k] != seen - added) return true;
    }
    return false;
}

/// Moves a box that counts from an origin to where it is in the world. False if it leaves the world.
inline bool move_to_world(const std::int32_t (&origin)[3], StepsBox& box) {
    for (int k = 0; k < 3; ++k) {
        // Both are within the world: the sums have 31 bits.
        box.low[k] += origin[k];
        box.high[k] += origin[k];
        if (box.low[k] < -most_world_steps || box.high[k] > most_world_steps) return false;
    }
    return true;
}
/// A lattice point at or below a coordinate of a box that is exact as a float: the origin of a tree.
constexpr std::int32_t lattice_point_below(std::int32_t steps) { return steps & ~127; }
constexpr std::int32_t lattice_point_above(std::int32_t steps) { return (steps + 127) & ~127; }

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

/// Returns whether every operation and query on the block is safe, and whether refit_boxes() leaves exact boxes in all
/// nodes: every index is in its range, the tree is of equal depth, each live slot is in it once, and every box is that
/// of what it holds. O(n); it writes nothing. The capacities have been checked.
bool is_sound(const SceneBlock& block);
/// Returns whether the slots of a sound block place the meshes and tiles of the scene, at the boxes that they have.
bool has_boxes_of_instances(const MovingScene& scene);

// The part of the world's lattice that instances of a moving scene share: rays are rounded for it once.

/// The number before an instance was on the common lattice.
inline constexpr std::uint8_t no_region = 0;
/// The largest number; a region twice as large would have more steps than a Lattice may.
inline constexpr std::uint8_t most_region = 7;

/// Returns a region that instances may share: a cube around the origin of a view. Number 1 reaches 2^17 steps to each
/// side, so that rays that begin in it have the finest grid, and each number twice as far as the one before. Were it as
/// small as the instances, each that comes or goes would change how rays are rounded for the others.
Lattice common_region(const BlockHead& head, std::uint8_t number);

/// Returns the number of the least region, no smaller than the head's, that holds the part of a slot at its place on
/// the lattice; the head's if none does. A slot that counts from another origin than 0 has the largest: a view near it
/// has it in a cube around itself, wherever it was placed from.
std::uint8_t common_region_with(const MovingScene& scene, const InstanceSlot& slot);

}  // namespace espalier::detail
