// Ray queries: the closest hit, any hit, the first few hits, all hits, and batches of rays.
//
// Rays are given in the blob's local space; to_local() of transform.hpp moves them there. Thread safety: any number of
// threads may query one blob. No call allocates. Numerics are described at the end of this file.
//
// Any bit pattern is a safe argument. Queries refuse, in O(1), a blob that is not open (not_open); a NaN, an infinite
// origin or direction, or a direction of length zero (invalid_argument); and an origin more than 2^120 lattice steps or
// all of float32 away from the blob's (out_of_range). An open blob without triangles is never hit.
#pragma once

#include <cstdint>
#include <span>

#include <espalier/blob.hpp>
#include <espalier/base/function_ref.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// The points origin + t * direction with t_min <= t <= t_max.
struct Ray {
    Vec3 origin;
    Vec3 direction;      ///< of any length but zero; t counts in multiples of it
    float t_min = 0.0f;  ///< below zero it counts as zero; above t_max the ray hits nothing
    float t_max = infinity;
    FaceCulling culling = FaceCulling::none;

    /// Returns the ray from one point to another: t runs from 0 to 1. Its direction is rounded like any other ray's, so
    /// that the end may lie off `to` by 2^-23 of the length.
    [[nodiscard]] static constexpr Ray between(const Vec3& from, const Vec3& to) noexcept {
        return {from, {to.x - from.x, to.y - from.y, to.z - from.z}, 0.0f, 1.0f, FaceCulling::none};
    }
};

/// The place where a ray hits a triangle. Converts to true if it does. A miss or a refusal has an infinite t and
/// no_triangle.
struct [[nodiscard]] RayHit {
    float t = infinity;                          ///< the point is origin + t * direction
    float u = 0.0f;                              ///< barycentric weight of corner b, as triangle_at() returns it
    float v = 0.0f;                              ///< barycentric weight of corner c; corner a has 1 - u - v
    Vec3 normal;                                 ///< of unit length, away from the triangle's front
    TriangleId triangle;                         ///< original_hit() maps it to the source mesh
    QueryStatus status = QueryStatus::not_open;  ///< ok, not_found, or why the ray was refused
    Side side = Side::front;                     ///< the side that was hit: exact, also where the normal is rounded
    std::uint8_t reserved[2] = {};

    explicit constexpr operator bool() const noexcept { return status == QueryStatus::ok; }
};

/// Returns the hit with the smallest t; of equal t the one with the lowest triangle. With a filter, as if the blob held
/// only the triangles that the filter keeps. Cost: expected O(log n); docs/queries/README.md, Bounded, has the bound.
RayHit raycast(const Blob& blob, const Ray& ray, TriangleFilter filter = {}) noexcept;

/// Returns whether the ray hits any triangle. Takes less time than raycast().
YesNo occluded(const Blob& blob, const Ray& ray, TriangleFilter filter = {}) noexcept;

/// Writes the first hits along the ray, as many as `hits` has places, sorted by t; of equal t by triangle. The first is
/// that of raycast(). A triangle with duplicate references appears once.
///
/// Status: ok, also if there is no hit; output_full if there are more hits than places; or why the ray was refused. The
/// rest of `hits` may be overwritten. Cost: visits all hits until there are more than places, then only nearer ones;
/// O(log(places)) for each hit, O(places) in a blob with duplicate references.
Filled closest_hits(const Blob& blob, const Ray& ray, std::span<RayHit> hits, TriangleFilter filter = {}) noexcept;

/// Calls the visitor with each hit, once, in ascending order of triangles and not of t. In a blob with duplicate
/// references a triangle comes at the first of its references whose boxes the ray passes through. Status: ok; stopped
/// by the visitor; or why the ray was refused.
QueryStatus for_each_hit(const Blob& blob, const Ray& ray, Visitor<const RayHit&> visit) noexcept;

/// Calls the visitor with each crossing of the surface, once: for counting, parity and thickness. The crossings are the
/// hits of for_each_hit() that the ray keeps when its origin moves by less than any number, always in one direction. A
/// shared edge or vertex that the ray meets exactly is one crossing, or as many as the surface has there: where the ray
/// only touches it two, a front and a back, or none. Along a ray that starts outside a closed surface, fronts and backs
/// cancel. Order, window and status are those of for_each_hit(); crossings at the same place have the same t.
QueryStatus for_each_crossing(const Blob& blob, const Ray& ray, Visitor<const RayHit&> visit) noexcept;

/// Writes to hits[i] what raycast() returns for rays[i], with its own status. It takes less time where successive rays
/// have similar origins and directions (groups of 16 traverse the tree together), or where the blob exceeds a core's
/// cache.
///
/// The spans must not overlap. Refused are spans of different sizes, with invalid_argument, and a blob that is not
/// open; then nothing is written. Takes more stack than a single ray: up to 12 KB, but hardly more on cores without
/// SIMD.
Filled raycast(const Blob& blob, std::span<const Ray> rays, std::span<RayHit> hits) noexcept;

/// Writes to answers[i] what occluded() returns for rays[i]. Same rules as the batched raycast().
Filled occluded(const Blob& blob, std::span<const Ray> rays, std::span<YesNo> answers) noexcept;

}  // namespace espalier

// Numerics
//
// A ray is rounded once onto a grid finer than the blob's lattice; from beyond 2^23 lattice steps, as finely as float32
// resolves its origin. The rounded ray is answered exactly: whether it hits a triangle within [t_min, t_max], and on
// which side, is decided in integers. Touching counts, and adjacent triangles never leave a gap. A ray within the plane
// of a triangle does not hit it. Equal t are compared before t is clamped to the window.
//
// t, u and v are within 4 ulp of the exact values (t is infinite where float32 ends), the normal's coordinates within
// 4 ulp of 1. The rounding mode must be to nearest, the default.
//
// With 23 or 24 bits, a ray from outside may be rounded to whole lattice steps, coarser than float32 resolves it close
// to the asset: one that is aimed exactly at a corner may miss it. Adjacent triangles leave no gap then either.
// rounding_error() returns how far a ray moves; docs/numerics.md has the bounds.
//
// How a ray is rounded depends on the blob: its origin, its extent and its distance. Round it once for several blobs
// that meet: rounding.hpp.
