// Rays against several blobs on one lattice, such as the tiles of a terrain: rounded once, so that none passes between
// two blobs that meet.
//
// Blobs lie on one lattice when they have one step (BakeOptions::step_exponent): their origins are whole multiples of
// it. `raycast(blob, ray)` rounds a ray for one blob, and by an amount that depends on that blob: its origin, its
// extent and its distance from the ray. Two neighbours may then test two slightly different rays, and a ray that is
// aimed at their common border may miss both. A RoundedRay is one ray of integers for all blobs of a region.
//
// Numbers. round_ray rounds as raycast does for a blob that fills the region: docs/numerics.md. What follows is exact:
// each blob is answered as by a loop over all its triangles, decided in integers, on every machine. Where two triangles
// share an edge or a vertex, in one blob or in two, there is no gap between them. t counts in the ray's direction, the
// same for all blobs: the nearest hit of several blobs is the one with the smallest t. Of equal t, which hits on a
// common edge may have, any order of the blobs serves; take the lowest blob to get the same hit each time.
//
// Range. A region is at most 2^24 - 1 steps long on each axis: 255 tiles of 16 bits in a row. The larger it is, the
// coarser the rounding. While the far end of the region is less than 2^18 steps from the ray's origin, the origin moves
// by at most 1.5 * 2^-7 of a step on each axis: the float32 subtraction rounds, then the grid. Each doubling of that
// distance doubles the bound, to 3/8 of a step at 2^23 steps. From farther away the origin first moves along the ray to
// the region: docs/numerics.md has that bound.
#pragma once

#include <cstdint>
#include <span>

#include <espalier/blob.hpp>
#include <espalier/lattice.hpp>
#include <espalier/ray.hpp>
#include <espalier/status.hpp>

namespace espalier {

namespace detail {

/// What round_ray leaves. point(tau) = origin * 2^-fraction_bits + tau * direction, in steps from the region's origin.
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
    Faces faces = Faces::both;
    std::uint8_t longest_axis = 0;
    std::uint8_t may_hit = 0;  ///< 0: the window is empty, or the ray passes the region by. No bool: any byte is sound
};

}  // namespace detail

/// A ray in whole numbers on the lattice of a region. Copied freely. By default it is refused.
class RoundedRay {
public:
    constexpr RoundedRay() noexcept = default;

    /// ok, or why round_ray refused the ray.
    [[nodiscard]] constexpr QueryStatus status() const noexcept { return data_.status; }
    [[nodiscard]] constexpr explicit operator bool() const noexcept { return data_.status == QueryStatus::ok; }

    /// For the library's own parts and its tests; its layout is no promise.
    [[nodiscard]] constexpr const detail::RoundedRayData& data() const noexcept { return data_; }

private:
    friend RoundedRay round_ray(const Lattice& region, const Ray& ray) noexcept;
    detail::RoundedRayData data_;
};

/// Finds the region around all blobs that have triangles: their common step, the lowest origin and the extent from
/// there. All zeros without triangles. invalid_argument where two steps differ, out_of_range where the region is longer
/// than 2^24 - 1 steps on an axis; `region` is then untouched. O(blobs).
QueryStatus lattice_of(std::span<const Blob> blobs, Lattice& region) noexcept;

/// Rounds a ray for all blobs within the region: lattice_of one or several blobs, or a box that the caller chose on
/// their lattice, with an origin that is a whole multiple of the step. The status is invalid_argument for a NaN, an
/// infinite origin or direction, a zero direction or what is no such region; out_of_range for an origin more than 2^120
/// steps or all of float32 away. An empty window is no error: such a ray hits nothing. O(1).
[[nodiscard]] RoundedRay round_ray(const Lattice& region, const Ray& ray) noexcept;

/// The closest hit, as of raycast(blob, ray, hit). Without one hit.triangle is no_triangle and hit.t infinite. ok, or
/// the ray's own status; invalid_argument for a blob with another step, out_of_range for one that reaches out of the
/// ray's region: `hit` is then untouched. A blob without triangles is never hit and never refused. invalid_argument
/// also for bits that are no rounded ray: any bits are safe.
QueryStatus raycast(const Blob& blob, const RoundedRay& ray, RayHit& hit) noexcept;

/// Whether the ray hits anything. Cheaper than the closest hit. The same statuses; `hit` is untouched unless ok.
QueryStatus occluded(const Blob& blob, const RoundedRay& ray, bool& hit) noexcept;

}  // namespace espalier
