// Ray queries: the closest hit, any hit, the first few hits, all hits, and batches of rays.
//
// Rays are given in the blob's local space; to_local() in transform.hpp moves a ray there. Any number of threads may
// query the same blob, and no call allocates. Numerics are described at the end of this file.
//
// Every bit pattern is a safe argument. A query refuses, in O(1), a blob that is not open (not_open); a NaN, an
// infinite origin or direction, or a direction of length zero (invalid_argument); and an origin that is more than 2^120
// lattice steps, or the whole range of float32, away from the blob's (out_of_range). An open blob without triangles is
// never hit.
#pragma once

#include <cstdint>
#include <span>

#include <espalier/blob.hpp>
#include <espalier/base/function_ref.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// The points origin + t * direction for t_min <= t <= t_max.
struct Ray {
    Vec3 origin;
    Vec3 direction;      ///< any length but zero; t counts in multiples of it
    float t_min = 0.0f;  ///< negative values count as zero; above t_max the ray hits nothing
    float t_max = infinity;
    FaceCulling culling = FaceCulling::none;

    /// Returns the ray from one point to another, along which t runs from 0 to 1. Like that of any other ray its
    /// direction is rounded, so the ray may end up to 2^-23 of its length away from `to`.
    [[nodiscard]] static constexpr Ray between(const Vec3& from, const Vec3& to) noexcept {
        return {from, {to.x - from.x, to.y - from.y, to.z - from.z}, 0.0f, 1.0f, FaceCulling::none};
    }
};

/// Where a ray hits a triangle. Converts to true if there is a hit; after a miss or a refusal, t is infinite and the
/// triangle is no_triangle.
struct [[nodiscard]] RayHit {
    float t = infinity;                          ///< the point is origin + t * direction
    float u = 0.0f;                              ///< barycentric weight of corner b of triangle_at()
    float v = 0.0f;                              ///< barycentric weight of corner c; that of corner a is 1 - u - v
    Vec3 normal;                                 ///< unit length, pointing away from the front of the triangle
    TriangleId triangle;                         ///< original_hit() maps it to the source mesh
    QueryStatus status = QueryStatus::not_open;  ///< ok, not_found, or why the ray was refused
    Side side = Side::front;                     ///< the side that was hit: exact, even where the normal is rounded
    std::uint8_t reserved[2] = {};

    explicit constexpr operator bool() const noexcept { return status == QueryStatus::ok; }
};

/// Returns the hit with the smallest t. If several hits have the same t, the lowest triangle wins. With a filter, the
/// query behaves as if the blob held only the triangles that the filter keeps. Expected cost: O(log n); for the worst
/// case see docs/queries/README.md, Bounded.
RayHit raycast(const Blob& blob, const Ray& ray, const TriangleFilter& filter = {}) noexcept;

/// Returns whether the ray hits any triangle, in less time than raycast().
YesNo occluded(const Blob& blob, const Ray& ray, const TriangleFilter& filter = {}) noexcept;

/// Writes the first hits along the ray, as many as `hits` has room for, sorted by t and, for equal t, by triangle. The
/// first is the one that raycast() returns. A triangle with duplicate references appears once.
///
/// Returns ok, even if there is no hit; output_full if there are more hits than `hits` has room for; or why the ray was
/// refused. The rest of `hits` may be overwritten. Cost: the query visits every hit until there are more than fit, and
/// then only nearer ones. Each takes O(log(hits.size())), or O(hits.size()) in a blob with duplicate references.
Filled closest_hits(const Blob& blob, const Ray& ray, std::span<RayHit> hits,
                    const TriangleFilter& filter = {}) noexcept;

/// Calls the visitor once for each hit, in ascending order of triangles rather than of t. In a blob with duplicate
/// references, a triangle is visited at the first of its references whose boxes the ray passes through. Returns ok,
/// stopped if the visitor ended the query, or why the ray was refused.
QueryStatus for_each_hit(const Blob& blob, const Ray& ray, Visitor<const RayHit&> visit) noexcept;

/// Calls the visitor once for each crossing of the surface, to count crossings, find the parity or measure thickness.
/// for_each_hit() reports every triangle that the ray meets, so a ray through a shared edge or vertex hits several at
/// once. This query keeps those of its hits that remain when the ray's origin is displaced infinitesimally, always in
/// the same direction. An edge or vertex is then one crossing, or as many as the surface has there: where the ray only
/// touches the surface two, a front and a back, or none. Along a ray that starts outside a closed surface, fronts and
/// backs cancel. Order, window and status are those of for_each_hit(), and crossings at the same place have the same t.
QueryStatus for_each_crossing(const Blob& blob, const Ray& ray, Visitor<const RayHit&> visit) noexcept;

/// Writes to hits[i] what raycast() returns for rays[i], each with its own status. A batch takes less time than single
/// calls where consecutive rays have similar origins and directions, because groups of 16 rays traverse the tree
/// together, or where the blob exceeds the cache of a core.
///
/// The spans must not overlap. If their sizes differ (invalid_argument) or the blob is not open, the batch is refused
/// and nothing is written. A batch takes up to 12 KB of stack, more than a single ray, but hardly more on cores without
/// SIMD.
Filled raycast(const Blob& blob, std::span<const Ray> rays, std::span<RayHit> hits) noexcept;

/// Writes to answers[i] what occluded() returns for rays[i]. Same rules as the batched raycast().
Filled occluded(const Blob& blob, std::span<const Ray> rays, std::span<YesNo> answers) noexcept;

}  // namespace espalier

// Numerics
//
// A ray is rounded once, onto a grid finer than the blob's lattice; if it starts more than 2^23 lattice steps away, as
// finely as float32 resolves its origin. The rounded ray is then answered exactly: integers decide whether it hits a
// triangle within [t_min, t_max], and on which side. Touching counts, and there is never a gap between adjacent
// triangles. A ray that lies in the plane of a triangle does not hit it. Hits are compared by t before t is clamped to
// the window.
//
// t, u and v are within 4 ulp of their exact values (t is infinite if it overflows float32), and each coordinate of the
// normal is within 4 ulp of 1. The floating-point rounding mode must be to nearest, which is the default.
//
// At 23 or 24 bits, a ray from outside may be rounded to whole lattice steps, which is coarser than float32 resolves it
// close to the asset: a ray aimed exactly at a corner may then miss it, although there is still no gap between adjacent
// triangles. rounding_error() returns how far a ray moves, and docs/numerics.md has the bounds.
//
// How a ray is rounded depends on the blob, namely on its origin, its extent and its distance. If several blobs meet,
// round the ray once for all of them (advanced/rounding.hpp).
