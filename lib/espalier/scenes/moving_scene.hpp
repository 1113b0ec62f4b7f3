// Scenes whose instances move, in a block of memory that the caller owns.
//
// A MovingScene holds instances of meshes, which are inserted, moved and removed at any time. Every query of scene.hpp
// and of contacts.hpp takes it, with the same arguments and answers: InstanceId::index is then a slot. They refuse a
// scene that waits for refit() (not_refitted), and call visitors in the order of the tree, which is the same on every
// machine, not in that of the slots. mesh_at() is for baked scenes alone. pairs.hpp finds the instances in it that may
// touch or do. A tile, a whole BakedScene, is inserted as a mesh is: queries then cover both what moves and what does
// not.
//
// Rays are rounded once for all instances on the common lattice, such as the pieces of a ground that come and go: no
// ray passes between two that share an edge. It is that of the world: its points are whole steps from the origin.
// common_lattice() describes what lies on it.
//
// A world that float32 does not resolve, such as 100 km with millimetres, is seen from places in it. A view that
// seen_from() makes takes and returns coordinates from its origin(), which is near the place: an instance that is
// inserted through it keeps its place exactly, and one that was inserted from elsewhere has its translation rounded
// once to float32. So every query is exact for the instances as they are seen from there, and those near the view lie
// where they were placed.
//
// The block has no pointers. A copy of its bytes is a snapshot: it may be written back over the block of the same
// scene, under views that exist, or opened elsewhere by open_moving_scene(). The same calls, those for pairs included,
// give the same bytes on every machine of one byte order.
//
// A step of a simulation moves many instances by one call of move() and then calls refit(). Boxes of instances are
// integers, in steps of the world. The tree over them is an R-tree: its depth is at most 12 for any order of calls.
//
// Thread safety: any number of threads may query a scene that no thread changes. No call allocates. Numerics and sizes
// are described at the end of this file.
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

/// The name of an instance of a MovingScene, from its insertion to its removal; afterwards it is stale and is refused.
/// The default names no instance.
struct InstanceHandle {
    std::uint32_t slot = 0xFFFFFFFFu;  ///< InstanceId::index of the results of queries; used again after a removal
    std::uint32_t generation = 0;
    friend constexpr auto operator<=>(const InstanceHandle&, const InstanceHandle&) = default;
};

/// An instance and the place that it moves to.
struct Movement {
    InstanceHandle instance;
    Transform transform;
};

namespace detail {

struct SceneBlock;
class MovingSceneAccess;

/// A container that is destroyed at the end of the call: what refers to its elements would dangle.
template <class Array>
concept TemporaryArray =
    !std::is_lvalue_reference_v<Array> && !std::ranges::enable_borrowed_range<std::remove_cv_t<Array>>;

}  // namespace detail

/// A view of a block, and of the meshes and tiles that its instances place. Copied freely; the block and the arrays
/// must outlive it. A default MovingScene is not open: calls refuse it with QueryStatus::not_open.
class [[nodiscard]] MovingScene {
public:
    constexpr MovingScene() noexcept = default;

    /// Returns whether the scene is open.
    [[nodiscard]] explicit constexpr operator bool() const noexcept { return block_ != nullptr; }

    [[nodiscard]] std::uint32_t instance_count() const noexcept;
    /// Returns the number of instances that there is room for.
    [[nodiscard]] std::uint32_t capacity() const noexcept;
    /// Returns a number above each slot that was ever used: for loops over all slots and handle_of().
    [[nodiscard]] std::uint32_t slot_end() const noexcept;
    /// Returns e; a step of the world is 2^e long.
    [[nodiscard]] int step_exponent() const noexcept;
    /// Returns the place in the world from which this view counts coordinates: a multiple of 128 steps on each axis. To
    /// give a place to the view, subtract the origin in float64 and round the difference to float32; to an answer, add
    /// it in float64. 0 unless seen_from() made the view.
    [[nodiscard]] Vec3d origin() const noexcept;
    /// Returns the region for which rays are rounded once: for instances whose transforms move by whole steps of the
    /// world and do nothing else, and whose meshes have a lattice with that step (Resolution::step(step_exponent)). For
    /// a tile, its own common lattice counts. Not found until there has been one.
    ///
    /// The region is a cube around the origin of the view, which reaches 2^17 steps to each side. It doubles until it
    /// holds such an instance that is inserted or moved beyond, up to 2^23 steps, and never shrinks: it changes six
    /// times at most, and no other instance that comes or goes changes how rays are rounded for the rest. An instance
    /// beyond 2^23 steps rounds rays for itself, as all do that are not on the lattice; so may one whose translation is
    /// beyond that. In a view from another origin than 0, and in a scene with instances that were inserted or moved
    /// through one, there is always a region, whose cube reaches 2^23 steps. To round for a region of your own, pass
    /// the rounded ray with the ray: raycast(scene, ray, rounded). O(1).
    [[nodiscard]] Result<Lattice> common_lattice() const noexcept;
    /// Returns whether instances were moved by a batch since the last refit(): queries then refuse the scene with
    /// not_refitted.
    [[nodiscard]] bool must_refit() const noexcept;
    /// Returns the bytes of the block, which a snapshot copies: at most as many as the memory has. Memory that a copy
    /// is written to needs room for them, as a block that was made with the same size has.
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

/// Returns the bytes of a block for so many instances, 1 .. 2^24, else 0: about 173 an instance. No order of insertions
/// and removals needs more. Most sizes are no multiple of 32: ::operator new(size, std::align_val_t{32}) returns
/// such memory.
[[nodiscard]] std::uint64_t moving_scene_bytes(std::uint32_t instances) noexcept;
/// Returns the fewest bytes that create_moving_scene() accepts: about 137 an instance. When nodes run out in such a
/// block, insert() repacks the tree, which takes O(n) time.
[[nodiscard]] std::uint64_t least_moving_scene_bytes(std::uint32_t instances) noexcept;

/// Makes an empty scene in memory whose address is a multiple of 32.
///
/// A step of the world is 2^step_exponent long, -100 .. 80; the world reaches 2^30 - 128 steps from the origin along
/// each axis. A thousandth of the smallest instance is a good step; with pieces of a ground, take the step of their
/// lattice (common_lattice()). `meshes` and `tiles` are what instances place; tiles are numbered after the meshes. Not
/// open if an argument is out of its range, or if the memory is misaligned or smaller than least_moving_scene_bytes().
/// Clears the memory that it uses, O(size).
///
/// Takes any meshes and tiles: insert() refuses those that are empty or not open. The scene refers to both arrays,
/// which must outlive it.
MovingScene create_moving_scene(std::span<std::byte> memory, std::uint32_t capacity, int step_exponent,
                                std::span<const Blob> meshes, std::span<const BakedScene> tiles = {}) noexcept;
/// Rejects temporary arrays at compile time: the scene would refer to elements that are gone.
template <class Meshes = std::span<const Blob>, class Tiles = std::span<const BakedScene>>
requires detail::TemporaryArray<Meshes> || detail::TemporaryArray<Tiles> MovingScene create_moving_scene(
    std::span<std::byte> memory, std::uint32_t capacity, int step_exponent, Meshes&& meshes, Tiles&& tiles = {})
= delete;

/// Proves that every call on a snapshot is safe and that its answers are exact, and returns a view of it. Not open if a
/// byte contradicts the others, or if an instance has another box with these meshes and tiles. Takes any bytes; writes
/// nothing. Their address must be a multiple of 32. Ignores bytes behind the block. O(n log n).
///
/// Blocks store the numbers of meshes and tiles, and no checksum of them: other ones with equal bounds and lattice
/// steps pass. The proof is no checksum of the block either: another mask, user word or generation, and another place
/// with the same box, are as valid as those before.
MovingScene open_moving_scene(std::span<std::byte> snapshot, std::span<const Blob> meshes,
                              std::span<const BakedScene> tiles = {}) noexcept;
/// Rejects temporary arrays at compile time: the scene would refer to elements that are gone.
template <class Meshes = std::span<const Blob>, class Tiles = std::span<const BakedScene>>
requires detail::TemporaryArray<Meshes> || detail::TemporaryArray<Tiles> MovingScene
open_moving_scene(std::span<std::byte> snapshot, Meshes&& meshes, Tiles&& tiles = {})
= delete;

/// Returns a view of the same block whose origin() is the multiple of 128 steps that is nearest to a place in the
/// world, on each axis. Not open if a coordinate is not finite or 2^30 - 64 steps or more from 0, or if the scene is
/// not open. Changes nothing: any number of views may be in use. O(1).
///
/// What counts from the origin: shapes and answers of queries, transforms that are inserted, moved and returned, boxes,
/// common_lattice(), and a baked scene in pairs with this one. What does not depend on it: the world's bounds, handles,
/// the tree, pairs, and the bytes of the block but for the instances that a view places. A view places none farther
/// than 2^30 - 128 steps from its origin (out_of_range), and does not round rays once for one whose translation it had
/// to round: bake meshes around their own origins, then those near the view are exact.
[[nodiscard]] MovingScene seen_from(const MovingScene& scene, const Vec3d& place) noexcept;

/// Inserts an instance; Instance::source is not stored. It takes the slot of the latest removal that is still free,
/// else the lowest that was never used.
///
/// Refuses a number that belongs to no mesh, a mesh that is not open or has no triangles, a tile that is not open, has
/// no instances or has tiles, or a transform that is not valid (invalid_argument), a place that is not in the world
/// (out_of_range), and a full scene (no_room). A refusal changes nothing. O(depth).
Result<InstanceHandle> insert(MovingScene& scene, const Instance& instance) noexcept;
/// Removes an instance. Refuses a handle that is stale or was never returned (stale_handle). O(depth).
QueryStatus remove(MovingScene& scene, InstanceHandle instance) noexcept;
/// Moves an instance. Refuses as insert() and remove() do; the instance then stays where it is. O(depth).
QueryStatus move(MovingScene& scene, InstanceHandle instance, const Transform& transform) noexcept;
/// Moves instances, one after the other; refit() must follow before the next query. Stops at the first that is refused:
/// Filled::count is then its index, and those before it are moved. O(1) each, several times cheaper than move().
///
/// Until refit() or repack(), queries and pairs are refused, also after an insertion that repacks. Every other call
/// goes on: changes and reads of single instances, box_of() with the new box, snapshots, and quality() of the old
/// boxes.
Filled move(MovingScene& scene, std::span<const Movement> movements) noexcept;
/// Renews the boxes of all instances of a mesh whose vertices moved (refit() of deformation.hpp), at the places that
/// they have; refit() of the scene must follow before the next query. Before this call, queries may miss the mesh;
/// after it they are refused until refit(). The instances count as moved.
///
/// Refuses a scene that is not open (not_open), a number that belongs to no mesh (invalid_argument), and a pose that
/// leaves the world at the place of an instance (out_of_range); a refusal changes nothing. O(slots).
QueryStatus move_instances_of(MovingScene& scene, std::uint32_t mesh) noexcept;
/// Changes what queries and pairs select an instance by. Refuses a stale handle. O(1).
QueryStatus set_mask(MovingScene& scene, InstanceHandle instance, std::uint32_t mask) noexcept;
/// Changes the caller's word of an instance. Refuses a stale handle. O(1).
QueryStatus set_user(MovingScene& scene, InstanceHandle instance, std::uint32_t user) noexcept;

/// Renews the boxes of the tree above instances that a batch has moved, each once. Returns how many nodes it renewed,
/// 0 for a scene that is not open. O(n / 8).
std::uint32_t refit(MovingScene& scene) noexcept;
/// Builds the tree anew, in Hilbert order (Kamel and Faloutsos 1994). The tree is then the same for the same instances,
/// whatever came before. Call it every few steps, or when quality() has risen. Includes refit(). O(n).
void repack(MovingScene& scene) noexcept;
/// Returns how much more surface the boxes of the tree have, for each instance, than after the last repack(): 1 is as
/// good, 1.3 and more is worth a repack. Below 1 if instances have come closer together since. Infinity before the
/// first repack(); 1 without instances. O(n / 8).
[[nodiscard]] float quality(const MovingScene& scene) noexcept;
/// Ends a step: no instance counts as moved until it is moved or inserted again (PairFilter::only_moved). What is
/// moved or inserted between the pairs of a step and this call is in no list of moved pairs. O(1).
void end_step(MovingScene& scene) noexcept;

/// Returns the handle of the instance in a slot. Refuses a slot that is free (not_found) or never was (out_of_range).
Result<InstanceHandle> handle_of(const MovingScene& scene, std::uint32_t slot) noexcept;
/// Returns an instance. Refuses a stale handle; Instance::source is the slot. O(1).
Result<Instance> instance_at(const MovingScene& scene, InstanceHandle instance) noexcept;
/// Returns the instance that a result or a pair names: that in the slot `index`. With `in_tile` it is the one in the
/// tile of that slot, whose transform leads to the tile's local space and whose mesh is one of the tile's. Refuses a
/// slot as handle_of() does, and an instance that the slot's tile does not have (invalid_argument). O(1).
Result<Instance> instance_at(const MovingScene& scene, InstanceId instance) noexcept;
/// Returns whether rays are rounded once for this instance and others: whether it lies in the region of
/// common_lattice() and on its lattice. With `in_tile`, both the tile and the instance in it must. Refuses what
/// instance_at() of an InstanceId refuses. O(1).
YesNo is_on_common_lattice(const MovingScene& scene, InstanceId instance) noexcept;
/// Returns the box of an instance in the tree, rounded outward to float. Refuses a stale handle. O(1).
Result<Box> box_of(const MovingScene& scene, InstanceHandle instance) noexcept;

}  // namespace espalier

// Numerics
//
// The box of an instance holds its mesh at its place, wider by 2^-16 of the mesh's size, 2^-6 of its lattice step (more
// than the common grid of two meshes moves a vertex), 2^-21 of the coordinates, and rounded outward to whole steps, so
// that tests of boxes are exact. Choices in the tree compare areas of these boxes in float, in one fixed order without
// fused operations: the tree has the same bytes on every machine. insert() searches for the leaf node with which boxes
// grow least by branch and bound (Bittner, Hapala and Havran 2015), in at most 24 nodes beside the first way down.
// repack() orders the middles of boxes on a grid of 2^10 cells along the longest axis.
//
// Sizes. A node has 4 to 8 children, the root 2 to 8, all leaf nodes are at one depth: 2 * 4^11 instances or more make
// 12 levels. An instance takes 84 bytes, a node 229.
