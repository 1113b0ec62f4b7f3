// Scenes whose instances move, in a block of memory that the caller owns.
//
// A MovingScene holds instances of meshes, which can be inserted, moved and removed at any time. A tile, which is a
// whole BakedScene, is inserted like a mesh, so that one query covers both what moves and what does not. Every query of
// scene.hpp and contacts.hpp takes a MovingScene, with the same arguments and answers, where InstanceId::index is a
// slot. Queries refuse a scene that waits for refit() (not_refitted), and call visitors in the order of the tree, which
// is the same on every machine, rather than in that of the slots. mesh_at() is limited to baked scenes, and bounds() is
// a function of SceneView. pairs.hpp finds the instances that may touch or do touch.
//
// Rays are rounded once for all instances on the common lattice, such as the pieces of a ground that come and go, so no
// ray slips between two that share an edge. This lattice belongs to the world: its points are whole steps from the
// origin. common_lattice() describes what lies on it.
//
// A world too large for float32, such as 100 km at a resolution of millimetres, is seen from positions in it. A view
// made by seen_from() is a MovingScene, too, and follows all changes of the block; a SceneView, to which a MovingScene
// converts for each query, is valid until the next change only. A view made by seen_from() takes and returns
// coordinates relative to its origin(), which is near such a position. An instance inserted through a view keeps its
// position exactly; for an instance inserted from elsewhere, the view rounds the translation once to float32. Every
// query is thus exact for the instances as seen from the view, and those near it lie where they were placed.
//
// The block contains no pointers. A copy of its bytes is a snapshot: write it back over the block of the same scene,
// even under existing MovingScenes, or open it elsewhere with open_moving_scene(). The same calls, including those for
// pairs, produce the same bytes on every machine of the same byte order.
//
// A simulation step moves many instances with one call of move() and then calls refit(). The boxes of instances are
// integers, in steps of the world. The tree over them is an R-tree, whose depth is at most 12 for any order of calls.
//
// Any number of threads may query a scene while no thread changes it. No call allocates. Numerics and sizes are
// described at the end of this file.
#pragma once

#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include <espalier/blob.hpp>
#include <espalier/scene.hpp>
#include <espalier/status.hpp>
#include <espalier/transform.hpp>

namespace espalier {

/// Identifies an instance of a MovingScene from its insertion to its removal. Afterwards the handle is stale, and calls
/// refuse it. The default names no instance.
struct InstanceHandle {
    std::uint32_t slot = 0xFFFFFFFFu;  ///< InstanceId::index in the results of queries; reused after a removal
    std::uint32_t generation = 0;
    friend constexpr auto operator<=>(const InstanceHandle&, const InstanceHandle&) = default;
};

/// An instance and where it moves.
struct Movement {
    InstanceHandle instance;
    Transform transform;
};

namespace detail {

struct SceneBlock;
class MovingSceneAccess;

/// A container that is destroyed at the end of the call, so that references to its elements would dangle.
template <class Array>
concept TemporaryArray =
    !std::is_lvalue_reference_v<Array> && !std::ranges::enable_borrowed_range<std::remove_cv_t<Array>>;

}  // namespace detail

/// A view of a block and of the meshes and tiles that its instances use. It can be copied freely; the block and the
/// arrays must outlive it. A default MovingScene is not open, and calls refuse it with QueryStatus::not_open.
class [[nodiscard]] MovingScene {
public:
    constexpr MovingScene() noexcept = default;

    /// Returns whether the scene is open.
    [[nodiscard]] explicit constexpr operator bool() const noexcept { return block_ != nullptr; }

    [[nodiscard]] std::uint32_t instance_count() const noexcept;
    /// Returns the number of instances that the block has room for.
    [[nodiscard]] std::uint32_t capacity() const noexcept;
    /// Returns a number above every slot that was ever used, for loops over all slots with handle_of().
    [[nodiscard]] std::uint32_t slot_end() const noexcept;
    /// Returns the exponent e of the world's step, which is 2^e long.
    [[nodiscard]] int step_exponent() const noexcept;
    /// Returns the position in the world from which this view counts coordinates, a multiple of 128 steps along each
    /// axis. To pass a position to the view, subtract the origin in float64 and round the difference to float32; to an
    /// answer, add the origin in float64. It is 0 unless seen_from() made the view.
    [[nodiscard]] Vec3d origin() const noexcept;
    /// Returns the region for which rays are rounded once. It serves instances whose transforms do nothing but
    /// translate by whole steps of the world, and whose meshes have a lattice with that step
    /// (Resolution::step(step_exponent)); for a tile, its own common lattice counts. The status is not_found until
    /// there has been such an instance.
    ///
    /// The region is a cube around the origin of the view that extends 2^17 steps to each side. When such an instance
    /// is inserted or moved beyond it, the region doubles until it contains the instance, up to 2^23 steps, and it
    /// never shrinks. So it changes at most six times, and no other instance that comes or goes changes how rays are
    /// rounded for the rest. An instance beyond 2^23 steps rounds rays for itself, like all instances off the lattice,
    /// and so may one whose translation is beyond that. In a view with an origin other than 0, and in a scene with
    /// instances that were inserted or moved through one, there is always a region, and it extends 2^23 steps. To round
    /// for a region of your own, pass the rounded ray with the ray: raycast(scene, ray, rounded). O(1).
    [[nodiscard]] Result<Lattice> common_lattice() const noexcept;
    /// Returns whether instances were moved by a batch since the last refit(). Queries then refuse the scene with
    /// not_refitted.
    [[nodiscard]] bool must_refit() const noexcept;
    /// Returns the bytes of the block, for taking a snapshot; there are at most as many as the memory has. Memory that
    /// receives a copy must have room for them, as does a block that was created with the same size.
    [[nodiscard]] std::span<const std::byte> bytes() const noexcept;
    /// Returns the scene as queries take it, valid until its next change. O(1).
    // NOLINTNEXTLINE(google-explicit-constructor): a moving scene is an argument of every query of scenes
    operator SceneView() const noexcept;
    [[nodiscard]] constexpr std::span<const Blob> meshes() const noexcept { return {meshes_, mesh_count_}; }
    [[nodiscard]] constexpr std::span<const BakedScene> tiles() const noexcept { return {tiles_, tile_count_}; }

private:
    friend class detail::MovingSceneAccess;
    std::byte* block_ = nullptr;
    const Blob* meshes_ = nullptr;
    const BakedScene* tiles_ = nullptr;
    std::uint32_t mesh_count_ = 0;
    std::uint32_t tile_count_ = 0;
    std::int32_t origin_[3] = {};  ///< in steps, multiples of 128
};

/// Returns the size of a block for so many instances, in bytes: about 173 per instance, and 0 unless `instances` is 1
/// .. 2^24. No order of insertions and removals needs more. Most sizes are not multiples of 32, but ::operator
/// new(size, std::align_val_t{32}) returns suitably aligned memory of any size.
[[nodiscard]] std::uint64_t moving_scene_bytes(std::uint32_t instances) noexcept;
/// Returns the fewest bytes that create_moving_scene() accepts: about 137 per instance. If such a block runs out of
/// nodes, insert() repacks the tree, which takes O(n).
[[nodiscard]] std::uint64_t least_moving_scene_bytes(std::uint32_t instances) noexcept;

/// Creates an empty scene in memory whose address is a multiple of 32.
///
/// A step of the world is 2^step_exponent long, -100 .. 80, and the world extends 2^30 - 128 steps from the origin
/// along each axis. A thousandth of the smallest instance is a good step; if there are pieces of a ground, use the step
/// of their lattice (see common_lattice()). `meshes` and `tiles` are what instances refer to, with tiles numbered after
/// the meshes. The scene is not open if an argument is out of range, or if the memory is misaligned or smaller than
/// least_moving_scene_bytes(). Clears the memory that it uses. O(size).
///
/// Any meshes and tiles are accepted here; insert() refuses those that are empty or not open. The scene refers to both
/// arrays, which must outlive it.
MovingScene create_moving_scene(std::span<std::byte> memory, std::uint32_t capacity, int step_exponent,
                                std::span<const Blob> meshes, std::span<const BakedScene> tiles = {}) noexcept;
/// Rejects temporary arrays at compile time, because the scene would refer to elements that no longer exist.
template <class Meshes = std::span<const Blob>, class Tiles = std::span<const BakedScene>>
requires detail::TemporaryArray<Meshes> || detail::TemporaryArray<Tiles> MovingScene create_moving_scene(
    std::span<std::byte> memory, std::uint32_t capacity, int step_exponent, Meshes&& meshes, Tiles&& tiles = {})
= delete;

/// Proves that every call on a snapshot is safe and that its answers are exact, and returns a view of it. The scene is
/// not open if its bytes contradict each other, or if an instance would have another box with these meshes and tiles.
/// Takes any bytes, writes nothing, and ignores bytes after the block. Their address must be a multiple of 32. O(n log
/// n).
///
/// Blocks store how meshes and tiles are numbered but no checksum of them, so other meshes with equal bounds and
/// lattice steps pass. Nor is the proof a checksum of the block: a different mask, user word or generation, or a
/// different transform with the same box, is as valid as the original.
MovingScene open_moving_scene(std::span<std::byte> snapshot, std::span<const Blob> meshes,
                              std::span<const BakedScene> tiles = {}) noexcept;
/// Rejects temporary arrays at compile time, because the scene would refer to elements that no longer exist.
template <class Meshes = std::span<const Blob>, class Tiles = std::span<const BakedScene>>
requires detail::TemporaryArray<Meshes> || detail::TemporaryArray<Tiles> MovingScene
open_moving_scene(std::span<std::byte> snapshot, Meshes&& meshes, Tiles&& tiles = {})
= delete;

/// Returns a view of the same block whose origin() is, along each axis, the multiple of 128 steps nearest to a position
/// in the world. The view is not open if a coordinate is not finite or is 2^30 - 64 steps or more from 0, or if the
/// scene is not open. Changes nothing: any number of views may be in use. O(1).
///
/// Relative to the origin are the shapes and answers of queries; transforms that are inserted, moved or returned;
/// boxes; common_lattice(); and a baked scene in pairs with this one. Independent of it are the bounds of the world,
/// handles, the tree, pairs, and the bytes of the block except for instances that a view places. A view places no
/// instance farther than 2^30 - 128 steps from its origin (out_of_range). It does not round rays once for an instance
/// whose translation it had to round, so bake meshes around their own origins: those near the view are then exact.
[[nodiscard]] MovingScene seen_from(const MovingScene& scene, const Vec3d& place) noexcept;

/// Inserts an instance; Instance::source is not stored. It takes the most recently removed slot that is still free, or
/// else the lowest that was never used.
///
/// Refuses an index that belongs to no mesh or tile; a mesh that is not open or has no triangles; a tile that is not
/// open, has no instances or contains tiles; and a transform that is not valid (invalid_argument). Refuses a position
/// outside the world (out_of_range) and a full scene (no_room). A refusal changes nothing. O(depth).
Result<InstanceHandle> insert(MovingScene& scene, const Instance& instance) noexcept;
/// Removes an instance. Refuses a handle that is stale or was never returned (stale_handle). O(depth).
QueryStatus remove(MovingScene& scene, InstanceHandle instance) noexcept;
/// Moves an instance. Refuses what insert() and remove() refuse, and the instance then stays where it is. O(depth).
QueryStatus move(MovingScene& scene, InstanceHandle instance, const Transform& transform) noexcept;
/// Moves instances one after the other; refit() must follow before the next query. Stops at the first movement that is
/// refused: Filled::count is then its index, and those before it are done. O(1) each, several times cheaper than move()
/// of a single instance.
///
/// Until refit() or repack(), queries and pairs are refused, even after an insertion that repacks. Every other call
/// still works: changing and reading single instances, box_of() with the new box, snapshots, and quality() of the old
/// boxes.
Filled move(MovingScene& scene, std::span<const Movement> movements) noexcept;
/// Updates the boxes of all instances of a mesh whose vertices moved (refit() of deformation.hpp); refit() of the scene
/// must follow before the next query. Until this call, queries may miss the mesh; after it, they are refused until
/// refit(). The instances count as moved.
///
/// Refuses a scene that is not open (not_open), an index that belongs to no mesh (invalid_argument), and a pose that
/// leaves the world where an instance is (out_of_range). A refusal changes nothing. O(slots).
QueryStatus move_instances_of(MovingScene& scene, std::uint32_t mesh) noexcept;
/// Changes the mask by which queries and pairs select an instance. Refuses a stale handle. O(1).
QueryStatus set_mask(MovingScene& scene, InstanceHandle instance, std::uint32_t mask) noexcept;
/// Changes the user word of an instance. Refuses a stale handle. O(1).
QueryStatus set_user(MovingScene& scene, InstanceHandle instance, std::uint32_t user) noexcept;

/// Updates the boxes of the tree above the instances that a batch moved, each once. Returns the number of nodes
/// updated, or 0 for a scene that is not open. O(n / 8).
std::uint32_t refit(MovingScene& scene) noexcept;
/// Rebuilds the tree in Hilbert order (Kamel and Faloutsos 1994). The result depends only on the instances, not on what
/// came before. Call it every few steps, or when quality() has risen. Includes refit(). O(n).
void repack(MovingScene& scene) noexcept;
/// Returns how much the surface of the tree's boxes has grown, per instance, since the last repack(). At 1 the tree is
/// as good as then, and from 1.3 on a repack is worthwhile. The value is below 1 if instances have moved closer
/// together, infinity before the first repack(), and 1 without instances. O(n / 8).
[[nodiscard]] float quality(const MovingScene& scene) noexcept;
/// Ends a step: no instance counts as moved until it is moved or inserted again (PairFilter::only_moved). Instances
/// that are moved or inserted after the pairs of a step were collected but before this call appear in no list of moved
/// pairs. O(1).
void end_step(MovingScene& scene) noexcept;

/// Returns the handle of the instance in a slot. Refuses a slot that is free (not_found) or was never used
/// (out_of_range).
Result<InstanceHandle> handle_of(const MovingScene& scene, std::uint32_t slot) noexcept;
/// Returns an instance, whose Instance::source is its slot. Refuses a stale handle. O(1).
Result<Instance> instance_at(const MovingScene& scene, InstanceHandle instance) noexcept;
/// Returns the instance that a result or a pair names, which is the one in the slot `index`. With `in_tile` it is an
/// instance in the tile of that slot: its transform leads to the tile's local space, and its mesh is one of the tile's.
/// Refuses a slot as handle_of() does, and an instance that the slot's tile does not have (invalid_argument). O(1).
Result<Instance> instance_at(const MovingScene& scene, InstanceId instance) noexcept;
/// Returns whether this instance shares the ray that is rounded once: whether it lies in the region of common_lattice()
/// and on its lattice. With `in_tile`, this must hold for both the tile and the instance in it. Refuses what
/// instance_at() of an InstanceId refuses. O(1).
YesNo is_on_common_lattice(const MovingScene& scene, InstanceId instance) noexcept;
/// Returns the box of an instance in the tree, rounded outward to float. Refuses a stale handle. O(1).
Result<Box> box_of(const MovingScene& scene, InstanceHandle instance) noexcept;

}  // namespace espalier

// Numerics
//
// The box of an instance contains its mesh as placed, enlarged by 2^-16 of the mesh's size, by 2^-6 of its lattice step
// (more than the common grid of two meshes moves a vertex) and by 2^-21 of the coordinates, and rounded outward to
// whole steps, so that tests of boxes are exact. Decisions about the tree compare the areas of these boxes in float, in
// a fixed order and without fused operations, so the tree has the same bytes on every machine. insert() finds the leaf
// node with which boxes grow least by branch and bound (Bittner, Hapala and Havran 2015), visiting at most 24 nodes
// beside those of the first way down. repack() orders the centers of boxes on a grid of 2^10 cells along the longest
// axis.
//
// Sizes. A node has 4 to 8 children, the root 2 to 8, and all leaf nodes have the same depth, so 12 levels take 2 *
// 4^11 instances or more. An instance takes 84 bytes, a node 229.
