// Rays and segments against a blob: closest hit, the first few hits, any hit, all hits, many rays in one call.
//
// Numbers. The ray is rounded once onto a grid finer than the asset's lattice (from beyond 2^23 lattice steps, as
// finely as float32 resolves its origin: docs/numerics.md), and that ray is answered exactly: whether a triangle is
// hit, within [t_min, t_max], is decided in integers, touching counts, and neighbours never leave a gap. t, u, v are
// within 4 ulp of the exact values (t is infinite where float32 ends), the normal's coordinates within 4 ulp of 1. A
// ray inside the plane of a triangle does not hit that triangle. The rounding mode must be to nearest, as it is unless
// a program changes it.
// With 23 or 24 bits a ray from outside may be rounded to whole lattice steps, coarser than float32 resolves it close
// to the asset: one that is aimed exactly at a corner may pass it by. Neighbours leave no gap then either. rounding.hpp
// returns how far a ray moves.
// How a ray is rounded depends on the blob: its origin, its extent, its distance. For several blobs that meet, round it
// once: rounded_ray.hpp.
//
// Arguments. Any bit pattern is safe. A NaN anywhere, an infinite origin or direction, a zero direction, or an origin
// more than 2^120 lattice steps or all of float32 away: no hit, O(1). t_max may be infinite; t_min below zero counts as
// zero; t_min > t_max hits nothing.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/blob.hpp>
#include <espalier/function_ref.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// Which sides of triangles a ray sees. The front is the side from which the corners run counter-clockwise.
enum class Faces : std::uint8_t { both, front, back };

struct Ray {
    Vec3 origin;
    Vec3 direction;  ///< any length; t counts in it
    float t_min = 0.0f;
    float t_max = __builtin_inff();
    Faces faces = Faces::both;
};

/// Corners are those of the blob (walk.hpp); which of the source's they are, OriginalTriangle says.
struct RayHit {
    float t = 0.0f;  ///< the point is origin + t * direction
    float u = 0.0f;  ///< barycentric weight of corner b
    float v = 0.0f;  ///< barycentric weight of corner c; corner a has 1 - u - v
    Vec3 normal;     ///< unit geometric normal of the front side
    Triangle triangle;
};

/// Called with a triangle that the ray hits; answers whether the hit counts. May be called for hits behind the closest
/// one, in no promised order: its answer must depend on the triangle alone. It must not throw.
using TriangleFilter = FunctionRef<bool(Triangle)>;

/// The hit with the smallest t, of equal t (before it is clamped into the window) the one with the lowest storage
/// index. `hit` is untouched when there is none.
bool raycast(const Blob& blob, const Ray& ray, RayHit& hit) noexcept;
bool raycast(const Blob& blob, const Ray& ray, RayHit& hit, TriangleFilter filter);

/// Whether the ray hits anything. Cheaper than the closest hit.
[[nodiscard]] bool occluded(const Blob& blob, const Ray& ray) noexcept;
[[nodiscard]] bool occluded(const Blob& blob, const Ray& ray, TriangleFilter filter);

/// The ray from `from` to `to`, t running from 0 to 1: for every query that takes a ray. Its direction, to - from,
/// rounds like any other ray's: the end may lie off `to` by 2^-23 of the length. A segment of length zero hits nothing.
constexpr Ray along(const Segment& segment) {
    const Vec3& from = segment.from;
    const Vec3& to = segment.to;
    return {from, {to.x - from.x, to.y - from.y, to.z - from.z}, 0.0f, 1.0f, Faces::both};
}
// Templates, so that two vectors in braces still mean a ray.
template <std::same_as<Segment> S>
bool raycast(const Blob& blob, const S& segment, RayHit& hit) noexcept {
    return raycast(blob, along(segment), hit);
}
template <std::same_as<Segment> S>
[[nodiscard]] bool occluded(const Blob& blob, const S& segment) noexcept {
    return occluded(blob, along(segment));
}

/// How many places of an array were filled, and whether (output_full) there would have been more.
struct HitCount {
    std::size_t count = 0;
    QueryStatus status = QueryStatus::ok;
};

/// The first hits along the ray, as many as `hits` has places, sorted as raycast chooses: by t before it is clamped
/// into the window, of equal t by storage index. The first is what raycast answers; a triangle that has copies appears
/// once. The rest of `hits` may be overwritten. Until there are more hits than places it looks at all of them,
/// afterwards only at what is nearer: O(log(places)) for each hit, O(places) in a blob with copies. With no places it
/// tells by the status whether there is any hit.
HitCount closest_hits(const Blob& blob, const Ray& ray, std::span<RayHit> hits) noexcept;
HitCount closest_hits(const Blob& blob, const Ray& ray, std::span<RayHit> hits, TriangleFilter filter);

/// The closest hit of each ray, the same to the bit as one call for each. Takes less time where rays next to each other
/// have about the same origin and direction (groups of 16 share their way), or where the blob exceeds a core's cache.
/// Answers as many rays as both spans have, and leaves the rest of `hits` untouched. hits[i] belongs to rays[i]; a ray
/// without a hit gets no_triangle, an infinite t and zeros. The spans must not overlap. How many rays hit. Takes more
/// stack than a single ray, up to 12 KB; on cores without lanes hardly more.
std::size_t raycast(const Blob& blob, std::span<const Ray> rays, std::span<RayHit> hits) noexcept;

/// Whether each ray hits anything: answers[i] is 1 or 0. Otherwise like the batch of closest hits.
std::size_t occluded(const Blob& blob, std::span<const Ray> rays, std::span<std::uint8_t> answers) noexcept;

/// Every hit, in storage order (not sorted by t), until the visitor answers stop. True when it saw them all. The
/// visitor must not throw. False at once, and nothing is visited, when blob.copy_count() is not 0.
bool for_each_hit(const Blob& blob, const Ray& ray, FunctionRef<Visit(const RayHit&)> visit);

}  // namespace espalier
