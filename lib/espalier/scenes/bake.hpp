// Baking scenes: joins blobs and the transforms of their instances. Offline code, like bake.hpp.
//
// Calls keep no state, so any number of threads may bake at once.
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

/// The figures of a baked scene.
struct SceneReport {
    std::uint32_t meshes = 0;  ///< distinct meshes that instances use
    std::uint32_t tiles = 0;   ///< distinct tiles that instances use
    std::uint32_t meshes_in_tiles = 0;
    std::uint32_t instances = 0;
    std::uint64_t triangles = 0;          ///< in all instances, including those in tiles
    std::uint64_t mesh_bytes = 0;         ///< total size of the meshes that are not in tiles
    std::uint64_t tile_bytes = 0;         ///< total size of the tiles
    std::uint64_t bytes = 0;              ///< size of the scene
    std::uint32_t nodes = 0;              ///< nodes of the tree over the instances
    unsigned depth = 0;                   ///< depth of that tree
    float max_error = 0.0f;               ///< the largest of any instance, in world units, including its placement
    std::uint32_t on_common_lattice = 0;  ///< instances whose rays are rounded once (BakedScene::common_lattice)
    Vec3d origin;                         ///< subtracted from all positions
    /// step_below_float_spacing: float32, relative to the origin, is coarser at an instance than a quarter of its
    /// lattice step. With an origin of 0, only instances that need float64 cause this warning.
    std::vector<BakeWarning> warnings;
};

/// The options of bake_scene().
struct SceneBakeOptions {
    /// Replaces the translations in the transforms of the instances, one for each. If empty, those of the transforms
    /// are used.
    std::span<const Vec3d> translations = {};
    /// An origin that is subtracted from every position of the source, so that float32 can hold the scene's
    /// coordinates, which count from there. The scene stores it (BakedScene::source_origin()) unless it is 0.
    ///
    /// If not set, an origin is chosen if float32 rounds positions at an instance by more than a quarter of its step
    /// and the instance needs float64 because its mesh has an origin or because of its translation, or if all instances
    /// lie far from 0 for their size. It is then near the middle of all instances and a multiple of every step of
    /// unscaled meshes. Otherwise it is 0.
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

/// Joins blobs and instances into a scene. Instance::mesh is an index into `blobs`; Instance::source is not read, and
/// becomes the index in `instances`. Blobs with equal bytes become one mesh, blobs without instances are omitted, and
/// scenes among the blobs become tiles.
///
/// A transform places what was the source of the mesh or tile: a point x of a blob or tile whose source_origin() is O
/// moves to rotation * (scale * (O + x)) + translation. From this the origin of the scene is subtracted, exactly, and
/// the scene stores the nearest translation in float32; max_error includes that rounding. Pieces of a map that were
/// each baked with an origin thus need no transform.
///
/// Refuses with invalid_mesh bytes that are not a sound blob, a tile that contains tiles, an instance of a blob that
/// does not exist, and a transform that to_local() does not accept. Refuses with invalid_options a number of
/// translations that differs from that of instances, and an origin that is not finite. Refuses with too_large more than
/// 2^24 instances, more than 2^32 - 1 bytes, and positions and errors that float32 cannot hold. No instances yield a
/// valid, empty scene. The bytes depend only on the arguments.
SceneBakeResult bake_scene(std::span<const std::span<const std::byte>> blobs, std::span<const Instance> instances,
                           const SceneBakeOptions& options = {});

/// Checks whether a scene is what its header states. Takes any bytes at any alignment.
///
/// A sound scene opens. Each mesh passes verify() and each tile verify_scene(). Every box of the tree contains the
/// instances below it, and the region contains their lattices. The common lattice is correct, and so is max_error,
/// except for the rounding of translations: those of the source are not stored, so it may include up to half of their
/// last bits.
VerifyReport verify_scene(std::span<const std::byte> bytes);

}  // namespace espalier
