// Rays: hits in storage order: whether there is any, and all of them.
#ifndef ESPALIER_RAYS_IN_ORDER_HPP
#define ESPALIER_RAYS_IN_ORDER_HPP

#include <runtime/kernels/crossing.hpp>
#include <runtime/lanes/set.hpp>
#include <runtime/rays/closest.hpp>

ESPALIER_BEGIN_SET

/// Whether there is any hit.
struct AnyHit {
    Limit limit;

    template <class Leaf>
    ESPALIER_PART_OF_CALLER Visit decide(const LatticeRay& ray, const Leaf& leaf, unsigned slot) const {
        return is_hit(leaf, slot, ray) ? Visit::stop : Visit::next;
    }
};

/// Whether there is any hit that the filter keeps. A type for each type of ray: small code inlines the walk of its only
/// caller.
template <class Caller>
struct AnyKeptHit {
    Limit limit;
    const TriangleFilter* filter;  ///< may be null

    template <class Leaf>
    ESPALIER_PART_OF_CALLER Visit decide(const LatticeRay& ray, const Leaf& leaf, unsigned slot) const {
        TriangleHit hit;
        if (!hits_slot(leaf, slot, ray, hit)) return Visit::next;
        return filter == nullptr || (*filter)(TriangleId{owner_index(leaf, slot)}) ? Visit::stop : Visit::next;
    }
};

/// Whether a hit matters. A pointer, not a type: the walk is then compiled once for all hits and for crossings, and a
/// program that lists hits alone does not link what decides on crossings.
using KeepsHit = bool (*)(const LatticeRay& ray, const LatticeTriangle& triangle);

/// Hits in storage order, handed to a callable. Their index is that of the reference.
template <class OnHit>
struct EveryHit {
    OnHit on_hit;
    KeepsHit keeps;  ///< null: all
    Limit limit;

    template <class Leaf>
    ESPALIER_PART_OF_CALLER Visit decide(const LatticeRay& ray, const Leaf& leaf, unsigned slot) const {
        FoundHit found;
        if (!hits_slot(leaf, slot, ray, found.hit)) return Visit::next;
        if (keeps != nullptr && !keeps(ray, leaf.triangle(slot))) return Visit::next;
        found.index = storage_index(leaf, slot);
        return on_hit(ray, found);
    }
};

/// Where triangles have duplicate references, visits only boxes that the ray passes through exactly: which references
/// it reaches does not depend on how lanes round.
template <class Leaf>
struct EveryHitShape : RayShape<Leaf> {
    const BlobData& blob;

    template <class Node>
    ESPALIER_ALWAYS_INLINE unsigned cull(const Node& node, Limit limit, Keys keys) const {
        const unsigned mask = RayShape<Leaf>::cull(node, limit, keys);
        if constexpr (Leaf::may_have_duplicates && reads_duplicate_references)
            if (blob.copies != nullptr) return children_passed(this->ray, node, blob.bits, mask);
        return mask;
    }
};

namespace {

/// Returns yes if the callable, which is called with the ray and each hit, stopped the walk.
template <class Leaf, class Caller, class OnHit>
ESPALIER_FOR_ONE_KIND_OF_LEAF inline YesNo every_hit_in(const BlobData& blob, const Caller& ray, KeepsHit keeps,
                                                        OnHit on_hit) {
    PreparedRayOf<typename Leaf::Node> prepared;
    if (const QueryStatus status = begin(blob, ray, prepared); status != QueryStatus::ok) return YesNo(status);
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
ESPALIER_FOR_ONE_KIND_OF_LEAF inline YesNo any_hit_in(const BlobData& blob, const Caller& ray, Filter... filter) {
    PreparedRayOf<typename Leaf::Node> prepared;
    if (const QueryStatus status = begin(blob, ray, prepared); status != QueryStatus::ok) return YesNo(status);
    RayQuery<Leaf, SomeAnswer> query = {{prepared.ray, prepared.lanes()}, {window_limit(prepared.ray), filter...}};
    return YesNo::of(walk_in_storage_order<PlaceOf<Leaf>>(blob, query) == Visit::stop);
}
template <class SomeAnswer, class Caller, class... Filter>
ESPALIER_ALWAYS_INLINE inline YesNo find_any_hit(const BlobData& blob, const Caller& ray, Filter... filter) {
    return with_leaves_of(blob, [&]<class Leaf>() ESPALIER_ALWAYS_INLINE_LAMBDA {
        return any_hit_in<Leaf, SomeAnswer>(blob, ray, filter...);
    });
}

template <class Caller>
ESPALIER_ALWAYS_INLINE inline YesNo find_any_kept_hit(const BlobData& blob, const Caller& ray,
                                                      const TriangleFilter* filter) {
    if constexpr (decides_by_signs)
        if (filter == nullptr) return find_any_hit<AnyHit>(blob, ray);
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

}  // namespace

ESPALIER_END_SET

#endif
