// Rays: the shape; the closest hit and the first few. Answers of rays decide on triangles themselves: each needs
// another part of a hit.
#ifndef ESPALIER_RAYS_CLOSEST_HPP
#define ESPALIER_RAYS_CLOSEST_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/rays/leaf_filter.hpp>
#include <runtime/rays/prepare_ray.hpp>
#include <runtime/rays/queries.hpp>
#include <runtime/traversal/query.hpp>

ESPALIER_BEGIN_SET

template <class Leaf>
struct RayShape {
    const LatticeRay& ray;
    const RayLanesOf<typename Leaf::Node>& lanes_;

    template <class Node>
    ESPALIER_ALWAYS_INLINE unsigned cull(const Node& node, Limit limit, Keys keys) const {
        return slab_test(node, lanes_, limit, keys);
    }
    template <class SomeAnswer>
    ESPALIER_ALWAYS_INLINE Visit scan(const PlaceOf<Leaf>& place, SomeAnswer& answer, QueryCounters* counters) const {
        RayLeaf<Leaf> leaf;
        auto candidates = ray_candidates(place, ray, leaf);
        if (counters != nullptr) {
            counters->count_leaf();
            counters->count_triangles(leaf.triangle_count());
            counters->count_candidates(static_cast<unsigned>(std::popcount(candidates)));
        }
        for (; candidates != 0; candidates &= candidates - 1)
            if (answer.decide(ray, leaf, static_cast<unsigned>(std::countr_zero(candidates))) == Visit::stop)
                return Visit::stop;
        return Visit::next;
    }
    template <class Node>
    [[nodiscard]] bool meets_any(const BlobData& blob, const Node& node, unsigned children) const {
        return children_passed(ray, node, blob.bits, children) != 0 && passes_down_to(ray, blob, node);
    }
};
template <class Leaf, class SomeAnswer>
using RayQuery = Query<RayShape<Leaf>, SomeAnswer, true>;

/// The closest hit; of equal ones the lowest index. One type for each type of ray that callers give: each is then used
/// by one query, and a program that never calls that query does not pay for it.
template <class Caller>
struct ClosestHit {
    RayHit* best;  ///< the caller's, undivided; a miss at first
    const TriangleFilter* filter;
    Limit limit;
    std::uint32_t volume_bits = 0;  ///< of the best, a float and its sign; 0 while there is none

    [[nodiscard]] bool found() const { return volume_bits != 0; }
    template <class SomeLeaf>
    ESPALIER_PART_OF_CALLER Visit decide(const LatticeRay& ray, const SomeLeaf& leaf, unsigned slot) {
        TriangleHit hit;
        if (!hits_slot(leaf, slot, ray, hit)) return Visit::next;
        // By their bits: neither is negative.
        const auto bits = [](float tau) { return std::bit_cast<std::int32_t>(tau); };
        const std::int32_t later = bits(hit.whole_tau) - bits(best->t);
        if (later > 0) return Visit::next;
        // On a tie, prefer the lower index.
        const std::uint32_t end = later == 0 ? best->triangle.index : no_triangle.index;
        const std::uint32_t index = owner_index(leaf, slot);
        // mutant(>= -> >) equivalent: the same triangle, again from a leaf with a copy, gives the same hit
        if (index >= end) return Visit::next;
        if (filter != nullptr && !(*filter)(TriangleId{index})) return Visit::next;
        // Small cores load it again: what GCC keeps of it in registers takes 8 bytes of their stack.
        const TriangleHit& kept = load_again(hit);
        set_undivided(*best, kept, index);
        volume_bits = std::bit_cast<std::uint32_t>(kept.volume);
        limit = hit_limit(ray, kept.whole_tau);
        return Visit::next;
    }
    /// Completes the best hit, once all of them are found.
    ESPALIER_PART_OF_CALLER void finish(const LatticeRay& rounded, const Caller& ray) const {
        divide_hit(*best, std::bit_cast<float>(volume_bits));
        best->t = to_t(rounded, best->t, ray);
    }
};

/// The first few hits by t, of equal t by index. Boxes are culled by the last of them as soon as it is known that there
/// are more.
struct FirstFewHits {
    FirstHits& hits;
    const TriangleFilter* filter;
    Limit limit;

    template <class Leaf>
    ESPALIER_PART_OF_CALLER Visit decide(const LatticeRay& ray, const Leaf& leaf, unsigned slot) {
        TriangleHit hit;
        if (!hits_slot(leaf, slot, ray, hit)) return Visit::next;
        const std::uint32_t index = owner_index(leaf, slot);
        if constexpr (Leaf::may_have_duplicates)
            if (hits.has(*leaf.blob, index)) return Visit::next;
        if (filter != nullptr && !(*filter)(TriangleId{index})) return Visit::next;
        hits.offer(to_ray_hit(hit, index));
        if (!hits.has_overflowed()) return Visit::next;
        if (hits.is_empty()) return Visit::stop;
        limit = hit_limit(ray, hits.largest_key());
        return Visit::next;
    }
};

namespace {

template <class Node>
using PreparedRayOf = PreparedRayIn<RayLanesOf<Node>>;

inline NoApproximation approximation(const BlobData&) { return {}; }
[[maybe_unused]] inline Approximation approximation(const BlobData& blob, const WalkAccuracy& accuracy) {
    return {blob, accuracy};
}

/// Prepares the ray. Returns ok, or why there is nothing to walk.
template <class Caller, class Prepared>
ESPALIER_ALWAYS_INLINE inline QueryStatus begin(const BlobData& blob, const Caller& ray, Prepared& prepared) {
    return blob.triangle_count != 0 ? prepare(blob, ray, prepared) : status_without_walk(blob, ray);
}

/// One function for each kind of leaf, the walk inside of it: one frame on the stack. For a Ray or a RayOnLattice.
template <class Leaf, class Caller, class... Counted>
ESPALIER_FOR_ONE_KIND_OF_LEAF inline RayHit closest_hit_in(const BlobData& blob, const Caller& ray,
                                                           const TriangleFilter* filter, const Counted&... counted) {
    PreparedRayOf<typename Leaf::Node> prepared;
    const QueryStatus status = begin(blob, ray, prepared);
    RayHit hit = miss_with(QueryStatus::not_found);  // known before the walk: small cores keep no status for it
    if (status != QueryStatus::ok) {
        if (!takes_shortcut() || status != QueryStatus::not_found) hit.status = status;  // no narrow store for a copy
        return hit;
    }
    Query<RayShape<Leaf>, ClosestHit<Caller>, sizeof...(Counted) == 0> query = {
        {prepared.ray, prepared.lanes()}, {&hit, filter, window_limit(prepared.ray)}, approximation(blob, counted...)};
    traverse_nearest_first<PlaceOf<Leaf>>(blob, query);
    if (query.answer.found()) query.answer.finish(prepared.ray, ray);
    return hit;
}

template <class Caller, class... Counted>
ESPALIER_ALWAYS_INLINE inline RayHit find_closest_hit(const BlobData& blob, const Caller& ray,
                                                      const TriangleFilter* filter, const Counted&... counted) {
    return with_leaves_of(blob, [&]<class Leaf>() ESPALIER_ALWAYS_INLINE_LAMBDA {
        return closest_hit_in<Leaf>(blob, ray, filter, counted...);
    });
}

}  // namespace

ESPALIER_END_SET

#endif
