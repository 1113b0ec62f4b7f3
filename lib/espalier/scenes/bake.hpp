// Baking scenes: joins blobs and the places of their instances. Offline code, as bake.hpp.
//
// Thread safety: no call keeps state; any number of threads may call them at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/scene.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// The figures of a scene that was baked.
struct SceneReport {
    std::uint32_t meshes = 0;  ///< distinct ones that instances use
    std::uint32_t tiles = 0;   ///< distinct ones that instances use
    std::uint32_t meshes_in_tiles = 0;
    std::uint32_t instances = 0;
    std::uint64_t triangles = 0;          ///< of all instances, those in tiles included
    std::uint64_t mesh_bytes = 0;         ///< of all meshes that are not in tiles
    std::uint64_t tile_bytes = 0;         ///< of all tiles
    std::uint64_t bytes = 0;              ///< of the scene
    std::uint32_t nodes = 0;              ///< of the tree over the instances
    unsigned depth = 0;                   ///< of that tree
    float max_error = 0.0f;               ///< the largest of any instance, in world units, placing included
    std::uint32_t on_common_lattice = 0;  ///< instances for which rays are rounded once (BakedScene::common_lattice)
    Vec3d origin;                         ///< that was subtracted from all places
    /// step_below_float_spacing: an instance lies where float32, from the origin, is coarser than a quarter of its
    /// lattice step. With an origin of 0, only of instances that need float64.
    std::vector<BakeWarning> warnings;
};

/// The options of bake_scene().
struct SceneBakeOptions {
    /// The translation of each instance, in place of that of its transform; empty: those of the transforms.
    std::span<const Vec3d> translations = {};
    /// Is subtracted from each place of the source: the scene's coordinates count from there, so that float32 holds
    /// them. The scene keeps it (BakedScene::source_origin), unless it is 0. None: chosen where float32 rounds places
    /// at an instance by more than a quarter of its step, if the instance needs float64, since its mesh has an origin
    /// or its translation does, or if all lie far from 0 for their size. Near the middle of all instances, and a
    /// multiple of every step of unscaled meshes. Else 0.
    std::optional<Vec3d> origin = Vec3d{};
};

/// The scene, or the reason why there is none. Converts to true if there is a scene.
struct [[nodiscard]] SceneBakeResult {
    std::vector<std::byte> bytes;  ///< empty unless status is ok
    SceneReport report;            ///< all zero unless status is ok
    BakeStatus status = BakeStatus::internal;
    std::string message;  ///< what is wrong, where, and what to do; empty if status is ok

    explicit operator bool() const noexcept { return status == BakeStatus::ok; }
};

/// Joins blobs and instances in one scene. Instance::mesh is an index into `blobs`; Instance::source is not read: it
/// becomes the index in `instances`. Blobs with equal bytes become one mesh, and blobs without instances are left out.
/// Scenes among the blobs become tiles.
///
/// A transform places what the source of the mesh or tile was: a point at x of a blob or tile whose source_origin() is
/// O comes to rotation * (scale * (O + x)) + translation. The origin of the scene is subtracted from this, exactly, and
/// the translation that the scene stores is the nearest in float32; max_error includes what that moves. So pieces of a
/// map that were baked with an origin each need no transform.
///
/// Refuses with invalid_mesh: bytes that are no sound blob, a tile with tiles, an instance of a blob that does not
/// exist, a transform that to_local() does not apply. Refuses with invalid_options: another number of translations than
/// of instances, an origin that is not finite. Refuses with too_large: more than 2^24 instances, more than
/// 2^32 - 1 bytes, places and errors that float32 cannot hold. No instances give a valid, empty scene. The bytes depend
/// on the arguments alone.
SceneBakeResult bake_scene(std::span<const std::span<const std::byte>> blobs, std::span<const Instance> instances,
                           const SceneBakeOptions& options = {});

/// Tests whether a scene is what its header states. Any bytes, any alignment.
///
/// A sound scene opens. Each mesh passes verify() and each tile verify_scene(). Every box of the tree contains the
/// instances below it, and the region their lattices. The common lattice is true, and so is max_error, but for the
/// rounding of translations: those of the source are not stored, and it may include up to half their last bits.
VerifyReport verify_scene(std::span<const std::byte> bytes);

}  // namespace espalier
