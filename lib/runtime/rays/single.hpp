// The queries of one ray, of an instruction set.
#ifndef ESPALIER_RAYS_SINGLE_HPP
#define ESPALIER_RAYS_SINGLE_HPP

#include <runtime/kernels/crossing.hpp>
#include <runtime/lanes/set.hpp>
#include <runtime/rays/answers.hpp>
#include <runtime/rays/prepare_ray.hpp>
#include <runtime/rays/queries.hpp>

ESPALIER_BEGIN_SET

namespace {

template <class Node>
using PreparedRayOf = PreparedRayIn<RayLanesOf<Node>>;

/// One function for each kind of leaf, the walk inside of it: one frame on the stack. For a Ray or a RayOnLattice.
template <class Leaf, class Caller, class... Counted>
ESPALIER_FOR_ONE_KIND_OF_LEAF inline RayHit closest_hit_in(const BlobData& blob, const Caller& ray,
                                                           const TriangleFilter& filter, const Counted&... counted) {
    PreparedRayOf<typename Leaf::Node> prepared;
    const QueryStatus status = prepare(blob, ray, prepared);
    RayHit hit = miss_with(QueryStatus::not_found);  // known before the walk: small cores keep no status for it
    if (status != QueryStatus::ok) {
        if (!takes_shortcut() || status != QueryStatus::not_found) hit.status = status;  // no narrow store for a copy
        return hit;
    }
    Query<RayShape<Leaf>, ClosestHit<Caller>, sizeof...(Counted) == 0> query = {
        {prepared.ray, prepared.lanes()}, {&hit, filter, window_limit(prepared.ray)}, {blob, counted...}};
    traverse_nearest_first<PlaceOf<Leaf>>(blob, query);
    if (query.answer.found()) query.answer.finish(prepared.ray, ray);
    return hit;
}

/// Returns yes if the callable, which is called with the ray and each hit, stopped the walk.
template <class Leaf, class Caller, class OnHit>
ESPALIER_FOR_ONE_KIND_OF_LEAF inline YesNo every_hit_in(const BlobData& blob, const Caller& ray, KeepsHit keeps,
                                                        OnHit on_hit) {
    PreparedRayOf<typename Leaf::Node> prepared;
    if (const QueryStatus status = prepare(blob, ray, prepared); status != QueryStatus::ok) return YesNo(status);
    Query<EveryHitShape<Leaf>, EveryHit<OnHit>, true> query = {{{prepared.ray, prepared.lanes()}, blob},
                                                               {on_hit, keeps, window_limit(prepared.ray)}};
    return YesNo::of(walk_in_storage_order<PlaceOf<Leaf>>(blob, query) == Visit::stop);
}
template <class Caller, class OnHit>
ESPALIER_ALWAYS_INLINE inline YesNo visit_every_hit(const BlobData& blob, const Caller& ray, KeepsHit keeps,
                                                    OnHit on_hit) {
    return with_leaves_of(
        blob, [&]<class Leaf>() ESPALIER_ALWAYS_INLINE_LAMBDA { return every_hit_in<Leaf>(blob, ray, keeps, on_hit); });
}

/// Returns whether there is any hit, by AnyHit, or by AnyKeptHit and a filter.
template <class Leaf, class SomeAnswer, class Caller, class... Filter>
ESPALIER_FOR_ONE_KIND_OF_LEAF inline YesNo any_hit_in(const BlobData& blob, const Caller& ray,
                                                      const Filter&... filter) {
    PreparedRayOf<typename Leaf::Node> prepared;
    if (const QueryStatus status = prepare(blob, ray, prepared); status != QueryStatus::ok) return YesNo(status);
    RayQuery<Leaf, SomeAnswer> query = {{prepared.ray, prepared.lanes()}, {window_limit(prepared.ray), filter...}};
    return YesNo::of(walk_in_storage_order<PlaceOf<Leaf>>(blob, query) == Visit::stop);
}
template <class SomeAnswer, class Caller, class... Filter>
ESPALIER_ALWAYS_INLINE inline YesNo find_any_hit(const BlobData& blob, const Caller& ray, const Filter&... filter) {
    return with_leaves_of(blob, [&]<class Leaf>() ESPALIER_ALWAYS_INLINE_LAMBDA {
        return any_hit_in<Leaf, SomeAnswer>(blob, ray, filter...);
    });
}

template <class Caller>
ESPALIER_ALWAYS_INLINE inline YesNo find_any_kept_hit(const BlobData& blob, const Caller& ray,
                                                      const TriangleFilter& filter) {
    if constexpr (decides_by_signs)
        if (!filter) return find_any_hit<AnyHit>(blob, ray);
    return find_any_hit<AnyKeptHit<Caller>>(blob, ray, filter);
}

template <class Caller>
ESPALIER_NOINLINE QueryStatus list_every_hit(const BlobData& blob, const Caller& ray, KeepsHit keeps,
                                             const Visitor<const RayHit&>& visit) {
    const YesNo is_stopped = visit_every_hit(blob, ray, keeps, [&](const LatticeRay& rounded, const FoundHit& found) {
        if (is_duplicate_reference(blob, found.index) && !is_first_reference(blob, found.index, rounded))
            return Visit::next;
        return visit(to_ray_hit(rounded, ray, found.hit, owner_of(blob, found.index)));
    });
    return is_stopped.yes() ? QueryStatus::stopped : of_list(is_stopped.status());
}

bool is_crossing_at(const LatticeRay& ray, const LatticeTriangle& triangle) { return is_crossing(ray, triangle); }

}  // namespace

ESPALIER_QUERY_OF_SET RayHit closest_hit(const BlobData& blob, const Ray& ray, const TriangleFilter& filter) {
    return with_leaves_of(
        blob, [&]<class Leaf>() ESPALIER_ALWAYS_INLINE_LAMBDA { return closest_hit_in<Leaf>(blob, ray, filter); });
}

ESPALIER_QUERY_OF_SET Filled first_hits(const BlobData& blob, const Ray& ray, std::span<RayHit> hits,
                                        const TriangleFilter& filter) {
    return with_leaves_of(blob, [&]<class Leaf>() -> Filled {
        PreparedRayOf<typename Leaf::Node> prepared;
        if (const QueryStatus status = prepare(blob, ray, prepared); status != QueryStatus::ok)
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
                                                    const TriangleFilter& filter) {
    return with_leaves_of(
        blob, [&]<class Leaf>() ESPALIER_ALWAYS_INLINE_LAMBDA { return closest_hit_in<Leaf>(blob, ray, filter); });
}

ESPALIER_QUERY_OF_SET YesNo any_hit(const BlobData& blob, const Ray& ray, const TriangleFilter& filter) {
    return find_any_kept_hit(blob, ray, filter);
}
ESPALIER_QUERY_OF_SET YesNo any_hit_on_lattice(const BlobData& blob, const RayOnLattice& ray,
                                               const TriangleFilter& filter) {
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
        if (const QueryStatus status = prepare(blob, ray, prepared); status != QueryStatus::ok) return YesNo(status);
        Query<RayShape<Leaf>, AnyHit, false> query = {
            {prepared.ray, prepared.lanes()}, {window_limit(prepared.ray)}, {blob, accuracy}};
        const bool is_hit = walk_in_storage_order<PlaceOf<Leaf>>(blob, query) == Visit::stop;
        return YesNo::of(is_hit || query.is_over());
    });
}

ESPALIER_END_SET

#endif
