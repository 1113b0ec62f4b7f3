// How far rounding moves a query, and rays that are rounded once for several blobs.
//
// Each query is rounded once, onto a grid at least as fine as the blob's lattice, and the rounded query is answered
// exactly. rounding_error() returns a bound on this rounding, in the blob's units: no point of the shape moves farther.
// Distances therefore change by no more than the bound, and the answer is the same for every surface that is farther
// than the bound from the shape's boundary. Blob::max_error() bounds the error of baking; the sum of the two bounds the
// error of an answer against the source.
//
// Blobs lie on one lattice if they were baked with the same step (Resolution::step), as the pieces of a terrain are:
// their origins are then whole multiples of it. raycast() rounds a Ray for one blob, by an amount that depends on the
// blob's origin, its extent and its distance. For two adjacent blobs it may thus test two slightly different rays, and
// a ray aimed at their common border may miss both. A RoundedRay is a single ray in integers for all blobs of a region,
// so it cannot slip between two blobs that meet. Its t counts in multiples of the ray's direction for every blob, and
// so the closest hit among several blobs is the one with the smallest t. Hits on a common edge may have equal t; take
// that of the lowest blob to get the same result each time.
//
// All calls cost O(1), except lattice_of() and the queries. Any number of threads may query the same blob, and no call
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

/// The shapes that rounding_error() takes, apart from a point.
template <class Shape>
concept RoundedShape = std::same_as<Shape, Ray> || std::same_as<Shape, Segment> || std::same_as<Shape, Sphere> ||
    std::same_as<Shape, Capsule> || std::same_as<Shape, Box> || std::same_as<Shape, OrientedBox> ||
    std::same_as<Shape, Triangle>;

/// Returns an upper bound on how far rounding moves the query. For a ray, this is the largest distance between the ray
/// and the rounded one inside the asset's box, regardless of t_min and t_max. For a Box, parts more than a lattice step
/// outside the asset's box may move farther in overlaps(), where they touch nothing. Returns 0 for a blob without
/// triangles.
///
/// Refuses a blob that is not open (not_open); a NaN, an infinity, a negative radius or a direction of zero
/// (invalid_argument); and a point 2^36 lattice steps or more from the asset, or a ray whose origin is 2^120 or more
/// away (out_of_range).
Result<float> rounding_error(const Blob& blob, Vec3 point) noexcept;
template <RoundedShape Shape>
Result<float> rounding_error(const Blob& blob, const Shape& shape) noexcept;

/// Returns an upper bound on how far rounding moves the shape of a sweep, at its start and anywhere on its way, since
/// its position, displacement and radius are all rounded. A body that touches nothing in one sweep may therefore touch
/// the same triangle at the start of the next. To prevent that, move the body away from the contact by the sum of both
/// sweeps' bounds and of the rounding of your own additions (docs/queries/sweeps.md, Slide along a surface).
///
/// Refuses what sweep() refuses. Returns 0 for a blob without triangles.
template <SweptShape Shape>
Result<float> rounding_error(const Blob& blob, const Shape& shape, Vec3 displacement) noexcept;

class RoundedRay;

namespace detail {

/// The result of round_ray(): point(tau) = origin * 2^-fraction_bits + tau * direction, in steps from the region's
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
    std::uint8_t may_hit = 0;  ///< 0: the window is empty, or the ray misses the region. Not a bool: any byte is valid
};

/// Shortens the ray's window to end at t_max at the latest. Hits up to there do not change.
void shorten(RoundedRay& ray, float t_max) noexcept;

}  // namespace detail

/// A ray in integers on the lattice of a region. Cheap to copy. A default RoundedRay is refused with invalid_argument.
class RoundedRay {
public:
    constexpr RoundedRay() noexcept = default;

    /// Returns ok, or why round_ray() refused the ray.
    [[nodiscard]] constexpr QueryStatus status() const noexcept { return data_.status; }
    [[nodiscard]] constexpr explicit operator bool() const noexcept { return data_.status == QueryStatus::ok; }

    /// Returns the internal data, for the library itself and its tests. The layout may change.
    [[nodiscard]] constexpr const detail::RoundedRayData& data() const noexcept { return data_; }

private:
    constexpr explicit RoundedRay(QueryStatus refusal) noexcept { data_.status = refusal; }

    friend RoundedRay round_ray(const Lattice& region, const Ray& ray) noexcept;
    friend RoundedRay to_local(const Transform& transform, const RoundedRay& ray) noexcept;
    friend void detail::shorten(RoundedRay& ray, float t_max) noexcept;
    detail::RoundedRayData data_;
};

/// Returns the region that encloses all blobs with triangles: their common step, the lowest origin, and the extent from
/// there. All are zero if no blob has triangles.
///
/// Refuses a blob that is not open (not_open), steps that differ (invalid_argument), and a region longer than 2^24 - 1
/// steps along an axis (out_of_range). O(number of blobs).
Result<Lattice> lattice_of(std::span<const Blob> blobs) noexcept;

/// Rounds a ray for all blobs in a region, which is lattice_of() one or more blobs, or a box of your choice on their
/// lattice whose origin is a whole multiple of the step. A ray with an empty window hits nothing.
///
/// Its status is ok; invalid_argument for a ray that raycast() refuses as such, and for a Lattice that is no such
/// region; or out_of_range for an origin more than 2^120 steps, or the whole range of float32, away. O(1).
[[nodiscard]] RoundedRay round_ray(const Lattice& region, const Ray& ray) noexcept;

/// Returns the closest hit, like raycast() of a Ray. A blob without triangles is never hit, whatever its lattice.
///
/// Refuses a blob that is not open (not_open); a refused ray, with the status of the ray; a blob with another step, and
/// bits that are no rounded ray (invalid_argument); and a blob that extends beyond the ray's region (out_of_range).
RayHit raycast(const Blob& blob, const RoundedRay& ray, const TriangleFilter& filter = {}) noexcept;

/// Returns whether the ray hits any triangle, in less time than raycast(). Refuses the same rays and blobs.
YesNo occluded(const Blob& blob, const RoundedRay& ray, const TriangleFilter& filter = {}) noexcept;

/// Calls the visitor with each hit, like for_each_hit() of a Ray. Refuses what raycast() refuses.
QueryStatus for_each_hit(const Blob& blob, const RoundedRay& ray, Visitor<const RayHit&> visit) noexcept;

/// Calls the visitor with each crossing, like for_each_crossing() of a Ray. Even where blobs share edges, each crossing
/// of their common surface is visited once. Refuses what raycast() refuses.
QueryStatus for_each_crossing(const Blob& blob, const RoundedRay& ray, Visitor<const RayHit&> visit) noexcept;

/// Moves a ray into the local space of a transform that translates by whole steps of its region's lattice and does
/// nothing else. The integers of the ray stay the same; only the origin of its region changes. Blobs placed by such
/// transforms, such as repeated pieces, thus meet one and the same ray.
///
/// Refuses a transform that rotates, scales, or translates by a fraction of a step (invalid_argument), and one that
/// moves the region to where float32 cannot represent its origin (out_of_range). A refused ray stays refused. O(1).
[[nodiscard]] RoundedRay to_local(const Transform& transform, const RoundedRay& ray) noexcept;

}  // namespace espalier

// Numerics
//
// rounding_error(). The bound, itself rounded up, depends on the blob, and on how far away the query is and how far it
// reaches. At 16 bits and near the asset it is slightly more than sqrt(3) / 128 of a lattice step. The largest movement
// among all queries that are as far away and reach as far is at least an eighth of the bound (docs/numerics.md). The
// grid of a sweep also depends on its displacement and radius. Planes and pairs of blobs are rounded onto other grids,
// which are described with them.
//
// round_ray(). A ray is rounded as raycast() rounds it for a blob that fills the region (docs/numerics.md). Everything
// after that is exact: on every machine, the answer for each blob is that of a loop over all its triangles, decided in
// integers. Where two triangles share an edge or a vertex, in one blob or in two, there is no gap between them.
//
// A region is at most 2^24 - 1 steps long along each axis, or 255 blobs of 16 bits in a row. The larger it is, the
// coarser the rounding. While the far end of the region is less than 2^18 steps from the ray's origin, the origin moves
// by at most 1.5 * 2^-7 of a step along each axis, because first the float32 subtraction rounds and then the grid. Each
// doubling of that distance doubles the bound, up to 3/8 of a step at 2^23 steps. If the origin is farther away, it is
// first moved along the ray to the region; docs/numerics.md has the bound for that.
