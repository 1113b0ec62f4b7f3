// The queries of one ray, of an instruction set.
#ifndef ESPALIER_RAYS_SINGLE_HPP
#define ESPALIER_RAYS_SINGLE_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/rays/closest.hpp>
#include <runtime/rays/in_order.hpp>
#include <runtime/rays/queries.hpp>

ESPALIER_BEGIN_SET

namespace {

bool is_crossing_at(const LatticeRay& ray, const LatticeTriangle& triangle) { return is_crossing(ray, triangle); }

}  // namespace

ESPALIER_QUERY_OF_SET RayHit closest_hit(const BlobData& blob, const Ray& ray, const TriangleFilter* filter) {
    return find_closest_hit(blob, ray, filter);
}

ESPALIER_QUERY_OF_SET Filled first_hits(const BlobData& blob, const Ray& ray, std::span<RayHit> hits,
                                        const TriangleFilter* filter) {
    return with_leaves_of(blob, [&]<class Leaf>() -> Filled {
        PreparedRayOf<typename Leaf::Node> prepared;
        if (const QueryStatus status = begin(blob, ray, prepared); status != QueryStatus::ok)
            return {0, {}, of_list(status)};
        FirstHits first(hits);
        RayQuery<Leaf, FirstFewHits> query = {{prepared.ray, prepared.lanes()},
                                              {first, filter, window_limit(prepared.ray)}};
        traverse_nearest_first<PlaceOf<Leaf>>(blob, query);
        const std::span<RayHit> found = first.sorted();
        for (RayHit& hit : found) hit.t = to_t(prepared.ray, hit.t, ray);
        return {found.size(), {}, first.has_overflowed() ? QueryStatus::output_full : QueryStatus::ok};
    });
}

ESPALIER_QUERY_OF_SET RayHit closest_hit_on_lattice(const BlobData& blob, const RayOnLattice& ray,
                                                    const TriangleFilter* filter) {
    return find_closest_hit(blob, ray, filter);
}

ESPALIER_QUERY_OF_SET YesNo any_hit(const BlobData& blob, const Ray& ray, const TriangleFilter* filter) {
    return find_any_kept_hit(blob, ray, filter);
}
ESPALIER_QUERY_OF_SET YesNo any_hit_on_lattice(const BlobData& blob, const RayOnLattice& ray,
                                               const TriangleFilter* filter) {
    return find_any_kept_hit(blob, ray, filter);
}

ESPALIER_QUERY_OF_SET QueryStatus every_hit(const BlobData& blob, const Ray& ray, Visitor<const RayHit&> visit) {
    return list_every_hit(blob, ray, nullptr, visit);
}
ESPALIER_QUERY_OF_SET QueryStatus every_crossing(const BlobData& blob, const Ray& ray, Visitor<const RayHit&> visit) {
    return list_every_hit(blob, ray, is_crossing_at, visit);
}
ESPALIER_QUERY_OF_SET QueryStatus every_hit_on_lattice(const BlobData& blob, const RayOnLattice& ray,
                                                       Visitor<const RayHit&> visit) {
    return list_every_hit(blob, ray, nullptr, visit);
}
ESPALIER_QUERY_OF_SET QueryStatus every_crossing_on_lattice(const BlobData& blob, const RayOnLattice& ray,
                                                            Visitor<const RayHit&> visit) {
    return list_every_hit(blob, ray, is_crossing_at, visit);
}

/// Also one that passes through a small box.
ESPALIER_QUERY_OF_SET YesNo may_hit(const BlobData& blob, const Ray& ray, const WalkAccuracy& accuracy) {
    return with_leaves_of(blob, [&]<class Leaf>() {
        PreparedRayOf<typename Leaf::Node> prepared;
        if (const QueryStatus status = begin(blob, ray, prepared); status != QueryStatus::ok) return YesNo(status);
        Query<RayShape<Leaf>, AnyHit, false> query = {
            {prepared.ray, prepared.lanes()}, {window_limit(prepared.ray)}, {blob, accuracy}};
        const bool is_hit = walk_in_storage_order<PlaceOf<Leaf>>(blob, query) == Visit::stop;
        return YesNo::of(is_hit || query.is_over());
    });
}

ESPALIER_END_SET

#endif
