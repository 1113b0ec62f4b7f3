// Scenes: one file with a few meshes and many instances of them, and queries over all instances.
//
// An instance is a mesh with a Transform that places it in the world. A scene stores each mesh once, as an ordinary
// blob, together with a tree over the boxes of the instances. Queries take shapes in world space and return results in
// world space.
//
// A tile is a scene that another scene instances in place of a mesh: a part of a world that is baked separately. The
// outer scene contains the whole bytes of the tile and queries it as it queries a mesh. Tiles contain no tiles.
//
// Answers are exact. They equal, bit for bit, those of a loop over all instances that moves the shape into each local
// space with to_local(), queries the blob or the tile, and moves the results back with to_world() and
// normal_to_world(); instances on the common lattice share the ray that round_ray() rounds for it. Of equally good
// triangles, the one in the lowest instance wins, then the lowest triangle.
//
// Any number of threads may query the same scene, and no call allocates. Numerics are described at the end of this
// file.
#pragma once

#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include <espalier/blob.hpp>
#include <espalier/distance.hpp>
#include <espalier/base/function_ref.hpp>
#include <espalier/overlap.hpp>
#include <espalier/ray.hpp>
#include <espalier/advanced/rounding.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/sweep.hpp>
#include <espalier/transform.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// The index of an instance in its scene, from 0 to BakedScene::instance_count() - 1. If that instance is a tile,
/// `in_tile` is the index of an instance in the tile. The default names no instance.
struct InstanceId {
    std::uint32_t index = 0xFFFFFFFFu;
    std::uint32_t in_tile = 0xFFFFFFFFu;  ///< not set for an instance of a mesh, nor for a tile as a whole
    friend constexpr auto operator<=>(const InstanceId&, const InstanceId&) = default;
};

/// The id that a miss returns; it belongs to no instance.
inline constexpr InstanceId no_instance = {};

/// A mesh or a tile, placed in the world.
struct Instance {
    Transform transform;  ///< from the mesh's local space to the world; for bake_scene(), from the space of its source
    std::uint32_t mesh = 0;           ///< index of its mesh in the scene; tiles are numbered after the meshes
    std::uint32_t mask = 0xFFFFFFFF;  ///< a query skips this instance unless the masks share a bit
    std::uint32_t user = 0;           ///< for the caller's use; the library never reads it
    std::uint32_t source = 0;         ///< its index in the list that was given to bake_scene()
};

class BakedScene;
class MovingScene;
class SceneView;

namespace detail {

struct MovingInstances;

/// What queries need to know about a scene: what open_scene() proved about its bytes, or the state of a MovingScene,
/// whose tree has nothing but a lattice. In a scene that was never opened all members are zero.
struct SceneData {
    BlobData tree;  ///< nodes and lattice of the tree over the instances, whose leaves are the records of instances
    const MovingInstances* moving = nullptr;  ///< the instances of a MovingScene, which replace those of the tree
    std::byte* block = nullptr;               ///< the block of a MovingScene; queries only read it
    const Blob* meshes = nullptr;
    const BakedScene* tiles = nullptr;
    std::uint32_t mesh_count = 0;
    std::uint32_t tile_count = 0;
    std::uint32_t instance_count = 0;
    Lattice common;  ///< the region of the instances that are translated by whole steps, if there is one
    bool has_common = false;
    float coarsest_step = 0.0f;  ///< the largest lattice step of any instance, in world units
    float largest_scale = 0.0f;
    float farthest_origin = 0.0f;  ///< how far outside the tree's region the origin of an instance may lie
    float view_slack = 0.0f;       ///< how far the view of a MovingScene may round a translation along an axis
    bool must_refit = false;       ///< whether a MovingScene refuses queries until refit()
    std::int32_t origin[3] = {};   ///< of the view of a MovingScene, in steps of its world
};

constexpr const SceneData& data_of(const SceneView& scene) noexcept;

}  // namespace detail

/// A scene as queries take it. A BakedScene is one, and a MovingScene (scenes/moving_scene.hpp) converts to one. It can
/// be copied freely; what it shows must outlive it and stay unchanged. Queries refuse a default view with not_open, and
/// the view of a MovingScene that waits for refit() with not_refitted.
class [[nodiscard]] SceneView {
public:
    constexpr SceneView() noexcept = default;

    /// Returns whether queries accept the scene.
    [[nodiscard]] explicit constexpr operator bool() const noexcept { return data_.tree.bytes != nullptr; }

    [[nodiscard]] constexpr std::uint32_t instance_count() const noexcept { return data_.instance_count; }
    /// Returns the meshes, each an open blob, without those of the tiles.
    [[nodiscard]] constexpr std::span<const Blob> meshes() const noexcept { return {data_.meshes, data_.mesh_count}; }
    /// Returns the tiles, each an open scene.
    [[nodiscard]] constexpr std::span<const BakedScene> tiles() const noexcept;
    /// Returns a box around the boxes and local origins of all instances, with each coordinate rounded to float. Both
    /// corners are zero if there are no instances.
    [[nodiscard]] Box bounds() const noexcept;

    /// Returns the region of the instances that lie on one lattice, such as the pieces of a ground: those whose
    /// transforms do nothing but translate by whole steps. Rays are rounded once for all of them. The status is
    /// not_found if there are none, or if they extend over more than 2^24 - 1 steps.
    [[nodiscard]] constexpr Result<Lattice> common_lattice() const noexcept {
        if (data_.tree.bytes == nullptr)
            return {{}, data_.must_refit ? QueryStatus::not_refitted : QueryStatus::not_open};
        return {data_.common, data_.has_common ? QueryStatus::ok : QueryStatus::not_found};
    }

protected:
    friend constexpr const detail::SceneData& detail::data_of(const SceneView& scene) noexcept;
    friend class MovingScene;
    detail::SceneData data_;
};

/// A baked scene, as opened by open_scene(). The bytes and the arrays of meshes and tiles must outlive it. A default
/// BakedScene was never opened and has no instances.
class [[nodiscard]] BakedScene : public SceneView {
public:
    constexpr BakedScene() noexcept = default;  // as an aggregate it could be made of any view

    /// Returns ok, not_opened, or why open_scene() refused the bytes.
    [[nodiscard]] constexpr OpenStatus status() const noexcept {
        if (data_.tree.bytes != nullptr) return OpenStatus::ok;
        return data_.tree.refusal == OpenStatus::ok ? OpenStatus::not_opened : data_.tree.refusal;
    }
    /// Returns the size in bytes, including meshes and tiles.
    [[nodiscard]] constexpr std::uint32_t size() const noexcept { return data_.tree.size; }
    /// Returns the largest distance between the surface of any instance and its source, in world units.
    [[nodiscard]] constexpr float max_error() const noexcept { return data_.tree.max_error; }
    /// Returns the point of the source that is the origin of the scene, in float64: what bake_scene() subtracted from
    /// all positions (SceneBakeOptions::origin). It is 0 for most scenes. A tile keeps an origin of its own, which no
    /// query of the scene around it uses: a transform leads from coordinates relative to the origin of a mesh or tile
    /// to coordinates relative to that of the scene.
    [[nodiscard]] Vec3d source_origin() const noexcept;

private:
    friend BakedScene open_scene(std::span<const std::byte> bytes, std::span<Blob> meshes,
                                 std::span<BakedScene> tiles) noexcept;
};

constexpr std::span<const BakedScene> SceneView::tiles() const noexcept { return {data_.tiles, data_.tile_count}; }

namespace detail {

/// Returns the internal data, for the library itself and its tests. The layout may change.
constexpr const SceneData& data_of(const SceneView& scene) noexcept { return scene.data_; }

}  // namespace detail

/// Returns the number of meshes that the header of a scene states, including those of its tiles. open_scene() needs an
/// array of this size. Returns 0 for bytes that are not a scene, or that are too few for so many meshes. Reads only the
/// header.
[[nodiscard]] std::uint32_t mesh_count_of_scene(std::span<const std::byte> bytes) noexcept;
/// Returns the number of tiles that the header of a scene states, for which open_scene() needs room as well.
[[nodiscard]] std::uint32_t tile_count_of_scene(std::span<const std::byte> bytes) noexcept;

/// Proves that every query on `bytes` is safe and returns a view of them. Writes an open Blob for each mesh to `meshes`
/// and an open scene for each tile to `tiles`, which must have at least mesh_count_of_scene() and tile_count_of_scene()
/// elements (otherwise: too_few_meshes).
///
/// Takes any bytes at any alignment. Reads only inside `bytes`, without heap or recursion, in time proportional to
/// their number. After a refusal, the elements of both arrays are open or empty. It does not prove that the tree
/// contains its instances; verify_scene() does.
BakedScene open_scene(std::span<const std::byte> bytes, std::span<Blob> meshes,
                      std::span<BakedScene> tiles = {}) noexcept;

/// Returns an instance or, with `in_tile`, an instance in a tile, whose transform leads to the tile's local space.
/// Refuses a scene that is not open (not_open) and an id out of range (invalid_argument). O(1).
Result<Instance> instance_at(const BakedScene& scene, InstanceId instance) noexcept;

/// Returns the mesh of an instance. Refuses what instance_at() refuses, and a tile as a whole (invalid_argument). O(1).
Result<Blob> mesh_at(const BakedScene& scene, InstanceId instance) noexcept;

/// Returns whether this instance shares the ray that is rounded once for the common lattice. Its transform must do
/// nothing but translate by whole steps of common_lattice(), and its mesh, or the common lattice of its tile, must lie
/// within that region. With `in_tile`, this must hold for both the tile and the instance in it. Refuses what
/// instance_at() refuses. O(1).
YesNo is_on_common_lattice(const BakedScene& scene, InstanceId instance) noexcept;

/// A callable that returns whether to keep a triangle of an instance. The default keeps all.
using SceneTriangleFilter = FunctionRef<bool(InstanceId, TriangleId)>;

/// Selects the instances and triangles that a query considers: instances whose mask shares a bit with `mask`, and those
/// of their triangles that the callable keeps. Use it as a parameter only, since it refers to the callable.
class SceneFilter {
public:
    constexpr SceneFilter() noexcept = default;
    // NOLINTNEXTLINE(google-explicit-constructor): a parameter type
    constexpr SceneFilter(std::uint32_t mask) noexcept : mask_(mask) {}
    template <class Callable>
    // NOLINTNEXTLINE(google-explicit-constructor): a parameter type
    constexpr SceneFilter(Callable&& keep ESPALIER_LIFETIMEBOUND) noexcept
        requires(std::is_invocable_r_v<bool, Callable&, InstanceId, TriangleId>)
        : keep_(std::forward<Callable>(keep)) {}
    constexpr SceneFilter(std::uint32_t mask, SceneTriangleFilter keep) noexcept : mask_(mask), keep_(keep) {}

    [[nodiscard]] constexpr std::uint32_t mask() const noexcept { return mask_; }
    [[nodiscard]] constexpr const SceneTriangleFilter& keep() const noexcept { return keep_; }

private:
    std::uint32_t mask_ = 0xFFFFFFFF;
    SceneTriangleFilter keep_;
};

/// The result of a query over a scene: that of the query over a blob, in world space, and the instance. Converts to
/// true if something was found.
template <class Hit>
struct [[nodiscard]] InScene {
    Hit hit;
    InstanceId instance;

    explicit constexpr operator bool() const noexcept { return hit.status == QueryStatus::ok; }
    constexpr const Hit& operator*() const noexcept { return hit; }
    constexpr const Hit* operator->() const noexcept { return &hit; }
};

/// Returns the hit with the smallest t. If several hits have the same t, the lowest instance wins, then the lowest
/// triangle.
///
/// Refuses what raycast() of a blob refuses, except that an origin is too far away (out_of_range) only if it is so for
/// an instance near the ray. Expected cost: O(log n) for n instances, plus the queries of the few blobs whose boxes the
/// ray passes through. It is O(n) for a direction shorter than 2^-70, or than 2^-70 times the largest scale.
InScene<RayHit> raycast(const SceneView& scene, const Ray& ray, const SceneFilter& filter = {}) noexcept;

/// Returns the same for a ray that was rounded for a region of your choice, so that several scenes meet the same ray.
/// Instances that lie in the region, translated by whole steps of its lattice, are tested with `rounded`, and so are
/// tiles whose common lattice does; all others are tested with `ray`. Both must be the same ray. Refuses in addition
/// what round_ray() refused (out_of_range, invalid_argument).
InScene<RayHit> raycast(const SceneView& scene, const Ray& ray, const RoundedRay& rounded,
                        const SceneFilter& filter = {}) noexcept;

/// Writes to hits[i] what raycast() returns for rays[i]. Refuses spans whose sizes differ (invalid_argument).
Filled raycast(const SceneView& scene, std::span<const Ray> rays, std::span<InScene<RayHit>> hits,
               const SceneFilter& filter = {}) noexcept;

/// Returns whether the ray hits any triangle. Refuses what raycast() refuses.
YesNo occluded(const SceneView& scene, const Ray& ray, const SceneFilter& filter = {}) noexcept;
YesNo occluded(const SceneView& scene, const Ray& ray, const RoundedRay& rounded,
               const SceneFilter& filter = {}) noexcept;

/// Calls the visitor with each hit, in ascending order of instances and, within one, of triangles. Returns ok, stopped
/// if the visitor ended the query, or why the ray was refused.
QueryStatus for_each_hit(const SceneView& scene, const Ray& ray, Visitor<InstanceId, const RayHit&> visit,
                         const SceneFilter& filter = {}) noexcept;
QueryStatus for_each_hit(const SceneView& scene, const Ray& ray, const RoundedRay& rounded,
                         Visitor<InstanceId, const RayHit&> visit, const SceneFilter& filter = {}) noexcept;

/// Returns the closest point of any surface within max_distance. Of equally close points, that in the lowest instance
/// wins, then that of the lowest triangle. Refuses what closest_point() of a blob refuses.
InScene<ClosestPoint> closest_point(const SceneView& scene, Vec3 point, float max_distance = infinity,
                                    std::uint32_t mask = 0xFFFFFFFF) noexcept;
/// Rejects a mask in place of the distance, which comes first.
template <class Mask>
requires std::same_as<Mask, std::uint32_t> InScene<ClosestPoint> closest_point(const SceneView& scene, Vec3 point,
                                                                               Mask mask)
= delete;

/// Like SweepOptions, for scenes. Use it as a parameter only, since it refers to the callable of the filter.
struct SceneSweepOptions {
    SceneFilter filter = {};                  ///< considers only the instances and triangles that it keeps
    FaceCulling culling = FaceCulling::none;  ///< as in SweepOptions
    bool ignore_leaving = false;              ///< as in SweepOptions, for each triangle on its own
    /// As in SweepOptions, in world units. It stops the shape before the first contact, which is found without it.
    float skin = 0.0f;
};

/// Returns the first contact of the shape as it moves by `displacement`. Of equally early contacts, that with the
/// lowest instance wins. A contact at the start comes first: of several instances that the shape touches there, the
/// lowest wins, and of its triangles the one that the shape penetrates most deeply.
///
/// Refuses what sweep() of a blob refuses. A Box is swept as the OrientedBox that it becomes in local space.
template <SweptShape Shape>
InScene<SweepHit> sweep(const SceneView& scene, const Shape& shape, Vec3 displacement,
                        const SceneSweepOptions& options = {}) noexcept;

/// Returns the first contact with a triangle that the filter keeps.
template <SweptShape Shape, std::convertible_to<SceneFilter> Filter>
InScene<SweepHit> sweep(const SceneView& scene, const Shape& shape, Vec3 displacement, Filter&& filter) noexcept {
    if constexpr (std::integral<std::remove_cvref_t<Filter>>)  // a mask: `1` would warn of its sign in here
        return sweep(scene, shape, displacement, SceneSweepOptions{.filter = static_cast<std::uint32_t>(filter)});
    else return sweep(scene, shape, displacement, SceneSweepOptions{.filter = filter});
}

/// Calls the visitor with each instance whose box in the tree, widened by the slack of rounding, touches the box, in
/// ascending order; for a tile, with each instance in it whose box does. The boxes in the tree are larger than their
/// instances, by up to a 127th of the scene's extent. Use it to build queries of your own.
QueryStatus for_each_candidate(const SceneView& scene, const Box& box, Visitor<InstanceId> visit,
                               std::uint32_t mask = 0xFFFFFFFF) noexcept;

/// The shapes that overlaps() and for_each_overlap() of a scene take.
template <class Shape>
concept SceneShape = std::same_as<Shape, Sphere> || std::same_as<Shape, Capsule> || std::same_as<Shape, Box> ||
    std::same_as<Shape, OrientedBox> || std::same_as<Shape, Triangle> || std::same_as<Shape, Cone>;

namespace detail {

/// A box around a shape, relative to one of its points, and whether queries accept the shape.
struct ShapeBounds {
    Vec3 anchor;
    Vec3 low;                              ///< relative to the anchor
    Vec3 high;                             ///< relative to the anchor
    QueryStatus status = QueryStatus::ok;  ///< not_found for a shape that contains no point
};
ShapeBounds bounds_of(const Sphere& sphere) noexcept;
ShapeBounds bounds_of(const Capsule& capsule) noexcept;
ShapeBounds bounds_of(const Box& box) noexcept;
ShapeBounds bounds_of(const OrientedBox& box) noexcept;
ShapeBounds bounds_of(const Triangle& triangle) noexcept;
ShapeBounds bounds_of(const Cone& cone) noexcept;

/// A shape of any type in world space, with the functions that query one blob and one tile for it.
struct AnySceneShape {
    const void* shape;
    ShapeBounds bounds;
    QueryStatus (*visit)(const Blob& blob, const Transform& transform, const void* shape, TriangleVisitor visit);
    YesNo (*test)(const Blob& blob, const Transform& transform, const void* shape);
    QueryStatus (*visit_tile)(const BakedScene& tile, const Transform& transform, const void* shape,
                              Visitor<InstanceId, TriangleId> visit, const SceneFilter& filter);
    YesNo (*test_tile)(const BakedScene& tile, const Transform& transform, const void* shape,
                       const SceneFilter& filter);

    template <SceneShape Shape>
    explicit AnySceneShape(const Shape& any) noexcept;
};

YesNo overlaps(const SceneView& scene, const AnySceneShape& shape, const SceneFilter& filter) noexcept;
QueryStatus for_each_overlap(const SceneView& scene, const AnySceneShape& shape, Visitor<InstanceId, TriangleId> visit,
                             const SceneFilter& filter) noexcept;

template <SceneShape Shape>
AnySceneShape::AnySceneShape(const Shape& any) noexcept
    : shape(&any),
      bounds(bounds_of(any)),
      visit([](const Blob& blob, const Transform& transform, const void* from, TriangleVisitor visit_triangle) {
          return espalier::for_each_overlap(blob, to_local(transform, *static_cast<const Shape*>(from)),
                                            visit_triangle);
      }),
      test([](const Blob& blob, const Transform& transform, const void* from) {
          return espalier::overlaps(blob, to_local(transform, *static_cast<const Shape*>(from)));
      }),
      visit_tile([](const BakedScene& tile, const Transform& transform, const void* from,
                    Visitor<InstanceId, TriangleId> visit_triangle, const SceneFilter& filter) {
          const auto local = to_local(transform, *static_cast<const Shape*>(from));
          return for_each_overlap(tile, AnySceneShape(local), visit_triangle, filter);
      }),
      test_tile([](const BakedScene& tile, const Transform& transform, const void* from, const SceneFilter& filter) {
          const auto local = to_local(transform, *static_cast<const Shape*>(from));
          return overlaps(tile, AnySceneShape(local), filter);
      }) {}

}  // namespace detail

/// Returns whether any triangle touches the shape. Refuses what overlaps() of a blob refuses.
template <SceneShape Shape>
[[nodiscard]] YesNo overlaps(const SceneView& scene, const Shape& shape, const SceneFilter& filter = {}) noexcept {
    return detail::overlaps(scene, detail::AnySceneShape(shape), filter);
}

/// Visits every triangle that touches the shape, in ascending order of instances and, within one, in the order of
/// for_each_overlap() of a blob. Returns ok, stopped, or a refusal.
template <SceneShape Shape>
QueryStatus for_each_overlap(const SceneView& scene, const Shape& shape, Visitor<InstanceId, TriangleId> visit,
                             const SceneFilter& filter = {}) noexcept {
    return detail::for_each_overlap(scene, detail::AnySceneShape(shape), visit, filter);
}

}  // namespace espalier

// Numerics
//
// The t of rays and sweeps is that of the local query, because to_local() preserves it. Points are those of to_world()
// and normals those of normal_to_world(); distances are local ones times the scale of the instance, rounded once.
// closest_point() passes max_distance / scale to the query of the blob. sweep() treats a skin alike, and moves it into
// local space like a radius. A hull is moved by moving its vertices. As in transforms, distances, products and
// quotients below 2^-100 count as zero. What a tile returns is transformed once more, and a tile compares distances
// before they are multiplied by its scale.
//
// The tree is conservative. It widens each box by as much as to_local() and the lattice of the instance may move a
// shape (docs/numerics.md, Scenes), so it never changes an answer. A gap can remain between two instances that share an
// edge if one of them is not on the common lattice: each instance then rounds the ray for itself, by a different
// amount, and baking has moved the two borders by up to the max_error of their meshes.
