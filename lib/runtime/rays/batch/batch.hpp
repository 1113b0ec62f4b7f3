// Batches of rays, once for each instruction set; the answers are those of one call for each ray. The blob has
// triangles.
#pragma once

#include <cstddef>

#include <espalier/ray.hpp>
#include <runtime/lanes/select.hpp>

namespace espalier::detail {

/// One ray after the other, by a query for single rays.
template <RayHit (*closest_hit)(const BlobData&, const Ray&, const TriangleFilter*)>
void closest_hits_one_by_one(const BlobData& blob, const Ray* rays, RayHit* hits, std::size_t count) {
    for (RayHit* const end = hits + count; hits != end; ++hits) *hits = closest_hit(blob, *rays++, nullptr);
}
template <YesNo (*any_hit)(const BlobData&, const Ray&, const TriangleFilter*)>
void any_hits_one_by_one(const BlobData& blob, const Ray* rays, YesNo* occluded, std::size_t count) {
    for (YesNo* const end = occluded + count; occluded != end; ++occluded) *occluded = any_hit(blob, *rays++, nullptr);
}

ESPALIER_IN_EACH_SET(void closest_hits(const BlobData& blob, const Ray* rays, RayHit* hits, std::size_t count);
                     void any_hits(const BlobData& blob, const Ray* rays, YesNo* occluded, std::size_t count);)

}  // namespace espalier::detail
