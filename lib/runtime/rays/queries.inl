// Rays: the queries.
#ifndef ESPALIER_IN_INSTRUCTION_SET  // parsed alone
#include <runtime/rays/shape.inl>
#include <runtime/rays/prepare_ray_portable.inl>
#include <runtime/rays/queries.hpp>
#endif

namespace {

template <class Node>
using PreparedRayOf = PreparedRayIn<RayLanesOf<Node>>;

inline NoApproximation approximation(const BlobData&) { return {}; }
[[maybe_unused]] inline Approximation approximation(const BlobData& blob, const WalkAccuracy& accuracy) {
    return {blob, accuracy};
}

/// Prepares the ray. Returns ok, or why there is nothing to walk.
template <class Caller, class Prepared>
[[gnu::always_inline]] inline QueryStatus begin(const BlobData& blob, const Caller& world, Prepared& prepared) {
    return blob.triangle_count != 0 ? prepare(blob, world, prepared) : status_without_walk(blob, world);
}

/// One function for each kind of leaf, the walk inside of it: one frame on the stack. For a Ray or a RayOnLattice.
template <class Leaf, class Caller, class... Counted>
ESPALIER_FOR_ONE_KIND_OF_LEAF inline RayHit closest_hit_in(const BlobData& blob, const Caller& world,
                                                           const TriangleFilter* filter, const Counted&... counted) {
    PreparedRayOf<typename Leaf::Node> prepared;
    const QueryStatus status = begin(blob, world, prepared);
    RayHit hit = miss_with(QueryStatus::not_found);  // known before the walk: small cores keep no status for it
    if (status != QueryStatus::ok) {
        hit.status = status;
        return hit;
    }
    Query<RayShape<Leaf>, ClosestHit<Caller>, sizeof...(Counted) == 0> query = {
        {prepared.ray, prepared.lanes()}, {&hit, filter, window_limit(prepared.ray)}, approximation(blob, counted...)};
    traverse_nearest_first<PlaceOf<Leaf>>(blob, query);
    if (query.answer.found()) query.answer.finish(prepared.ray, world);
    return hit;
}

template <class Caller, class... Counted>
[[gnu::always_inline]] inline RayHit find_closest_hit(const BlobData& blob, const Caller& world,
                                                      const TriangleFilter* filter, const Counted&... counted) {
    return with_leaves_of(
        blob, [&]<class Leaf>()
                  __attribute__((always_inline)) { return closest_hit_in<Leaf>(blob, world, filter, counted...); });
}

/// Returns yes if the callable, which is called with the ray and each hit, stopped the walk.
template <class Leaf, class Caller, class OnHit>
ESPALIER_FOR_ONE_KIND_OF_LEAF inline YesNo every_hit_in(const BlobData& blob, const Caller& world, OnHit on_hit) {
    PreparedRayOf<typename Leaf::Node> prepared;
    if (const QueryStatus status = begin(blob, world, prepared); status != QueryStatus::ok) return YesNo(status);
    Query<EveryHitShape<Leaf>, EveryHit<OnHit>, true> query = {{{prepared.ray, prepared.lanes()}, blob},
                                                               {on_hit, window_limit(prepared.ray)}};
    return YesNo::of(walk_in_storage_order<PlaceOf<Leaf>>(blob, query) == Visit::stop);
}
template <class Caller, class OnHit>
[[gnu::always_inline]] inline YesNo visit_every_hit(const BlobData& blob, const Caller& world, OnHit on_hit) {
    return with_leaves_of(
        blob, [&]<class Leaf>() __attribute__((always_inline)) { return every_hit_in<Leaf>(blob, world, on_hit); });
}

/// Returns whether there is any hit, by AnyHit, or by AnyKeptHit and a filter.
template <class Leaf, class SomeAnswer, class Caller, class... Filter>
ESPALIER_FOR_ONE_KIND_OF_LEAF inline YesNo any_hit_in(const BlobData& blob, const Caller& world, Filter... filter) {
    PreparedRayOf<typename Leaf::Node> prepared;
    if (const QueryStatus status = begin(blob, world, prepared); status != QueryStatus::ok) return YesNo(status);
    RayQuery<Leaf, SomeAnswer> query = {{prepared.ray, prepared.lanes()}, {window_limit(prepared.ray), filter...}};
    return YesNo::of(walk_in_storage_order<PlaceOf<Leaf>>(blob, query) == Visit::stop);
}
template <class SomeAnswer, class Caller, class... Filter>
[[gnu::always_inline]] inline YesNo find_any_hit(const BlobData& blob, const Caller& world, Filter... filter) {
    return with_leaves_of(
        blob, [&]<class Leaf>()
                  __attribute__((always_inline)) { return any_hit_in<Leaf, SomeAnswer>(blob, world, filter...); });
}

}  // namespace

RayHit closest_hit(const BlobData& blob, const Ray& world, const TriangleFilter* filter) {
    return find_closest_hit(blob, world, filter);
}

Filled first_hits(const BlobData& blob, const Ray& world, std::span<RayHit> hits, const TriangleFilter* filter) {
    return with_leaves_of(blob, [&]<class Leaf>() -> Filled {
        PreparedRayOf<typename Leaf::Node> prepared;
        if (const QueryStatus status = begin(blob, world, prepared); status != QueryStatus::ok)
            return {0, {}, of_list(status)};
        FirstHits first(hits);
        RayQuery<Leaf, FirstFewHits> query = {{prepared.ray, prepared.lanes()},
                                              {first, filter, window_limit(prepared.ray)}};
        traverse_nearest_first<PlaceOf<Leaf>>(blob, query);
        const std::span<RayHit> found = first.sorted();
        for (RayHit& hit : found) hit.t = to_t(prepared.ray, hit.t, world);
        return {found.size(), {}, first.has_overflowed() ? QueryStatus::output_full : QueryStatus::ok};
    });
}

YesNo any_hit(const BlobData& blob, const Ray& world, const TriangleFilter* filter) {
    if constexpr (decides_by_signs)
        if (filter == nullptr) return find_any_hit<AnyHit>(blob, world);
    return find_any_hit<AnyKeptHit>(blob, world, filter);
}

QueryStatus every_hit(const BlobData& blob, const Ray& world, Visitor<const RayHit&> visit) {
    const YesNo is_stopped = visit_every_hit(blob, world, [&](const LatticeRay& ray, const FoundHit& found) {
        if (is_duplicate_reference(blob, found.index) && !is_first_reference(blob, found.index, ray))
            return Visit::next;
        return visit(to_ray_hit(ray, world, found.hit, owner_of(blob, found.index)));
    });
    return is_stopped.yes() ? QueryStatus::stopped : of_list(is_stopped.status());
}

RayHit closest_hit_on_lattice(const BlobData& blob, const RayOnLattice& ray) {
    return find_closest_hit(blob, ray, nullptr);
}

YesNo any_hit_on_lattice(const BlobData& blob, const RayOnLattice& ray) { return find_any_hit<AnyHit>(blob, ray); }

/// Also one that passes through a small box.
YesNo may_hit(const BlobData& blob, const Ray& world, const WalkAccuracy& accuracy) {
    return with_leaves_of(blob, [&]<class Leaf>() {
        PreparedRayOf<typename Leaf::Node> prepared;
        if (const QueryStatus status = begin(blob, world, prepared); status != QueryStatus::ok) return YesNo(status);
        Query<RayShape<Leaf>, AnyHit, false> query = {
            {prepared.ray, prepared.lanes()}, {window_limit(prepared.ray)}, {blob, accuracy}};
        const bool is_hit = walk_in_storage_order<PlaceOf<Leaf>>(blob, query) == Visit::stop;
        return YesNo::of(is_hit || query.is_over());
    });
}
