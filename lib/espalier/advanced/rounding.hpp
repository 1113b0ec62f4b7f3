// Rounding: a bound on how far a query moves when it is rounded, and rays that are rounded once for several blobs.
//
// Each query is rounded once, onto a grid at least as fine as the blob's lattice, and the rounded query is answered
// exactly. rounding_error() returns a bound on that rounding in the blob's units: no point of the shape moves farther.
// So a distance changes by no more, and the answer stays the same for every surface that is farther from the shape's
// boundary. Blob::max_error bounds what baking moved; the sum of both bounds an answer's error against the source.
//
// Blobs lie on one lattice, such as the pieces of a terrain, if they were baked with one step (Resolution::step): their
// origins are whole multiples of it. raycast() of a Ray rounds it for one blob, by an amount that depends on the blob's
// origin, its extent and its distance. Two adjacent blobs may then test two slightly different rays, and a ray that is
// aimed at their common border may miss both. A RoundedRay is one ray of integers for all blobs of a region, so that
// none passes between two blobs that meet. Its t counts in the ray's direction for all of them, so that the closest hit
// of several blobs is the one with the smallest t. Hits on a common edge may have equal t; take the one of the lowest
// blob to get the same result each time.
//
// Cost: O(1), but for lattice_of() and queries. Thread safety: any number of threads may query one blob. No call
// allocates. Numerics are described at the end of this file.
#pragma once

#include <concepts>
#include <cstdint>
#include <span>

#include <espalier/blob.hpp>
#include <espalier/ray.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

struct Transform;  // transform.hpp

/// What rounding_error() takes beside a point.
template <class Shape>
concept RoundedShape = std::same_as<Shape, Ray> || std::same_as<Shape, Segment> || std::same_as<Shape, Sphere> ||
    std::same_as<Shape, Capsule> || std::same_as<Shape, Box> || std::same_as<Shape, OrientedBox> ||
    std::same_as<Shape, Triangle>;

/// Returns how far rounding moves the query at most. For a ray: the largest distance of the rounded ray from it inside
/// of the asset's box, without regard to t_min and t_max. For a Box: parts that are more than a lattice step outside of
/// the asset's box may move farther in overlaps(), where they touch nothing. 0 for a blob without triangles.
///
/// Refuses a blob that is not open (not_open), a NaN, an infinity, a negative radius or a zero direction
/// (invalid_argument), and a point that is 2^36 lattice steps or more from the asset, or the origin of a ray that is
/// 2^120 or more (out_of_range).
Result<float> rounding_error(const Blob& blob, Vec3 point) noexcept;
template <RoundedShape Shape>
Result<float> rounding_error(const Blob& blob, const Shape& shape) noexcept;

/// Returns how far rounding moves the shape of a sweep at most, at its start and anywhere on its way: place,
/// displacement and radius are all rounded. A body that touches nothing in one sweep may therefore touch the same
/// triangle at the start of the next one. To prevent that, move it away from the contact by the sum of both sweeps'
/// bounds and of the rounding of your own additions (docs/queries/sweeps.md, Slide along a surface).
///
/// Refuses what sweep() refuses. 0 for a blob without triangles.
template <SweptShape Shape>
Result<float> rounding_error(const Blob& blob, const Shape& shape, Vec3 displacement) noexcept;

class RoundedRay;

namespace detail {

/// The result of round_ray(). point(tau) = origin * 2^-fraction_bits + tau * direction, in steps from the region's
/// origin.
struct RoundedRayData {
    std::int32_t origin[3] = {};
    std::int32_t fraction_bits = 0;
    std::int32_t direction[3] = {};
    std::int32_t t_exponent = 0;
    float tau_min = 0.0f;
    float tau_max = 0.0f;
    float tau_offset = 0.0f;
    float t_min = 0.0f;
    float t_max = 0.0f;
    Lattice region;
    QueryStatus status = QueryStatus::invalid_argument;
    FaceCulling culling = FaceCulling::none;
    std::uint8_t longest_axis = 0;
    std::uint8_t may_hit = 0;  ///< 0: the window is empty, or the ray passes the region by. No bool: any byte is sound
};

/// Ends the ray's window no later than at t_max: its hits up to there stay the same.
void shorten(RoundedRay& ray, float t_max) noexcept;

}  // namespace detail

/// A ray in whole numbers on the lattice of a region. Copied freely. The default is refused: invalid_argument.
class RoundedRay {
public:
    constexpr RoundedRay() noexcept = default;

    /// Returns ok, or why round_ray() refused the ray.
    [[nodiscard]] constexpr QueryStatus status() const noexcept { return data_.status; }
    [[nodiscard]] constexpr explicit operator bool() const noexcept { return data_.status == QueryStatus::ok; }

    /// Returns the inner data: for the library's own parts and its tests. Its layout may change.
    [[nodiscard]] constexpr const detail::RoundedRayData& data() const noexcept { return data_; }

private:
    constexpr explicit RoundedRay(QueryStatus refusal) noexcept { data_.status = refusal; }

    friend RoundedRay round_ray(const Lattice& region, const Ray& ray) noexcept;
    friend RoundedRay to_local(const Transform& transform, const RoundedRay& ray) noexcept;
    friend void detail::shorten(RoundedRay& ray, float t_max) noexcept;
    detail::RoundedRayData data_;
};

/// Returns the region around all blobs that have triangles: their common step, the lowest origin, and the extent from
/// there. Without triangles all are zero.
///
/// Refuses a blob that is not open (not_open), two steps that differ (invalid_argument), and a region longer than
/// 2^24 - 1 steps on an axis (out_of_range). O(blobs).
Result<Lattice> lattice_of(std::span<const Blob> blobs) noexcept;

/// Returns the ray rounded for all blobs within the region: lattice_of() one or several blobs, or a box that the caller
/// chose on their lattice, with an origin that is a whole multiple of the step. A ray with an empty window hits
/// nothing.
///
/// Status: ok; invalid_argument for a ray that raycast() refuses with it, and for a Lattice that is no such region; or
/// out_of_range for an origin more than 2^120 steps or all of float32 away. O(1).
[[nodiscard]] RoundedRay round_ray(const Lattice& region, const Ray& ray) noexcept;

/// Returns the closest hit, as raycast() of a Ray does. A blob without triangles is never hit.
///
/// Refuses a blob that is not open (not_open), a ray that was refused (with its status), a blob with another step and
/// bits that are no rounded ray (invalid_argument), and a blob that reaches out of the ray's region (out_of_range). The
/// lattice of a blob without triangles may be any.
RayHit raycast(const Blob& blob, const RoundedRay& ray, TriangleFilter filter = {}) noexcept;

/// Returns whether the ray hits any triangle. Takes less time than raycast(), and refuses the same rays and blobs.
YesNo occluded(const Blob& blob, const RoundedRay& ray, TriangleFilter filter = {}) noexcept;

/// Calls the visitor with each hit, as for_each_hit() of a Ray does. Refuses as raycast() does.
QueryStatus for_each_hit(const Blob& blob, const RoundedRay& ray, Visitor<const RayHit&> visit) noexcept;

/// Calls the visitor with each crossing, as for_each_crossing() of a Ray does: also where edges are shared between
/// blobs each crossing of the whole surface is visited once. Refuses as raycast() does.
QueryStatus for_each_crossing(const Blob& blob, const RoundedRay& ray, Visitor<const RayHit&> visit) noexcept;

/// Moves a ray into the local space of a transform that only moves by whole steps of its region's lattice: the result
/// equals the ray in whole numbers, and only the origin of its region differs. Blobs that such transforms place, as
/// pieces that repeat, then meet one ray.
///
/// Refuses a transform that rotates or scales, or moves by no multiple of the step (invalid_argument); and one that
/// moves the region to where float32 cannot hold its origin (out_of_range). A refused ray stays refused. O(1).
[[nodiscard]] RoundedRay to_local(const Transform& transform, const RoundedRay& ray) noexcept;

}  // namespace espalier

// Numerics
//
// rounding_error(). The bound is a function of the blob and of how far the query lies and reaches, rounded up. At 16
// bits and near the asset it is sqrt(3) / 128 of a lattice step and a little more. The largest move among queries that
// lie and reach as far is at least an eighth of it (docs/numerics.md). The grid of a sweep depends on its displacement
// and radius too. Planes and pairs of blobs are rounded onto other grids, which are described there.
//
// round_ray(). It rounds as raycast() does for a blob that fills the region: docs/numerics.md. What follows is exact:
// each blob is answered as by a loop over all its triangles, decided in integers, on every machine. Where two triangles
// share an edge or a vertex, in one blob or in two, there is no gap between them.
//
// A region is at most 2^24 - 1 steps long on each axis: 255 blobs of 16 bits in a row. The larger it is, the coarser
// the rounding. While the far end of the region is less than 2^18 steps from the ray's origin, the origin moves by at
// most 1.5 * 2^-7 of a step on each axis: the float32 subtraction rounds, then the grid. Each doubling of that distance
// doubles the bound, to 3/8 of a step at 2^23 steps. From farther away the origin first moves along the ray to the
// region: docs/numerics.md has that bound.
