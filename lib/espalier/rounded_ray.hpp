// Rays against several blobs on one lattice, such as the tiles of a terrain: rounded once, so that none passes between
// two blobs that meet.
//
// Blobs lie on one lattice if they were baked with one step (Resolution::step): their origins are whole multiples of
// it. raycast() of a Ray rounds it for one blob, by an amount that depends on the blob's origin, its extent and its
// distance. Two adjacent blobs may then test two slightly different rays, and a ray that is aimed at their common
// border may miss both. A RoundedRay is one ray of integers for all blobs of a region. Its t counts in the ray's
// direction for all of them, so that the closest hit of several blobs is the one with the smallest t. Hits on a common
// edge may have equal t; take the one of the lowest blob to get the same result each time.
//
// Thread safety: any number of threads may query one blob. No call allocates. Numerics are described at the end of this
// file.
#pragma once

#include <cstdint>
#include <span>

#include <espalier/blob.hpp>
#include <espalier/lattice.hpp>
#include <espalier/ray.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

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
    friend RoundedRay round_ray(const Lattice& region, const Ray& ray) noexcept;
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
RayHit raycast(const Blob& blob, const RoundedRay& ray) noexcept;

/// Returns whether the ray hits any triangle. Takes less time than raycast(), and refuses the same rays and blobs.
YesNo occluded(const Blob& blob, const RoundedRay& ray) noexcept;

}  // namespace espalier

// Numerics
//
// round_ray() rounds as raycast() does for a blob that fills the region: docs/numerics.md. What follows is exact: each
// blob is answered as by a loop over all its triangles, decided in integers, on every machine. Where two triangles
// share an edge or a vertex, in one blob or in two, there is no gap between them.
//
// A region is at most 2^24 - 1 steps long on each axis: 255 tiles of 16 bits in a row. The larger it is, the coarser
// the rounding. While the far end of the region is less than 2^18 steps from the ray's origin, the origin moves by at
// most 1.5 * 2^-7 of a step on each axis: the float32 subtraction rounds, then the grid. Each doubling of that distance
// doubles the bound, to 3/8 of a step at 2^23 steps. From farther away the origin first moves along the ray to the
// region: docs/numerics.md has that bound.
