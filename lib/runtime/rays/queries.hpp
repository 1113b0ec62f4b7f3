// The ray queries, once for each instruction set: rounded, answered in lattice units, translated back. All may refuse
// the blob or the ray.
#pragma once

#include <cstddef>

#include <espalier/base/function_ref.hpp>
#include <espalier/ray.hpp>
#include <runtime/answers/answer.hpp>
#include <runtime/lanes/select.hpp>
#include <runtime/lattice/round_ray.hpp>

namespace espalier::detail {

struct RoundedRayData;

/// Returns not_open for a blob that was never opened or that open() refused, else not_found.
constexpr QueryStatus nothing_in(const BlobData& blob) {
    return blob.bytes == nullptr ? QueryStatus::not_open : QueryStatus::not_found;
}
/// Returns why a ray that is not walked has no hit: invalid_argument, out_of_range, or not_found if it is a sound ray.
QueryStatus refusal_or_miss(const BlobData& blob, const Ray& ray);
/// Returns why a query walks nothing: not_open, the refusal of the ray, or not_found if the blob has no triangles, the
/// ray passes it, or the window is empty.
QueryStatus status_without_walk(const BlobData& blob, const Ray& ray);
/// Returns ok, or why queries refuse a rounded ray: out_of_range, or invalid_argument.
QueryStatus refusal_of(const RoundedRayData& ray);
inline QueryStatus status_without_walk(const BlobData&, const RayOnLattice&) { return QueryStatus::not_found; }

ESPALIER_IN_EACH_SET(
    RayHit closest_hit(const BlobData& blob, const Ray& ray, const TriangleFilter& filter);
    Filled first_hits(const BlobData& blob, const Ray& ray, std::span<RayHit> hits, const TriangleFilter& filter);
    YesNo any_hit(const BlobData& blob, const Ray& ray, const TriangleFilter& filter);
    QueryStatus every_hit(const BlobData& blob, const Ray& ray, Visitor<const RayHit&> visit);
    QueryStatus every_crossing(const BlobData& blob, const Ray& ray, Visitor<const RayHit&> visit);
    YesNo may_hit(const BlobData& blob, const Ray& ray, const WalkAccuracy& accuracy);
    RayHit closest_hit_on_lattice(const BlobData& blob, const RayOnLattice& ray, const TriangleFilter& filter);
    YesNo any_hit_on_lattice(const BlobData& blob, const RayOnLattice& ray, const TriangleFilter& filter);
    QueryStatus every_hit_on_lattice(const BlobData& blob, const RayOnLattice& ray, Visitor<const RayHit&> visit);
    QueryStatus every_crossing_on_lattice(const BlobData& blob, const RayOnLattice& ray, Visitor<const RayHit&> visit);
    // Batches, of a blob that has triangles; the answers are those of one call for each ray.
    void closest_hits(const BlobData& blob, const Ray* rays, RayHit* hits, std::size_t count);
    void any_hits(const BlobData& blob, const Ray* rays, YesNo* occluded, std::size_t count);)

}  // namespace espalier::detail
