// Rays: the shape, and what becomes of the triangles that it leaves. Answers of rays decide on triangles themselves:
// each needs another part of a hit.
#ifndef ESPALIER_RAYS_ANSWERS_HPP
#define ESPALIER_RAYS_ANSWERS_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/rays/leaf_filter.hpp>
#include <runtime/traversal/query.hpp>

ESPALIER_BEGIN_SET

template <class Leaf>
struct RayShape {
    const LatticeRay& ray;
    const RayLanesOf<typename Leaf::Node>& ray_lanes;

    template <class Node>
    ESPALIER_ALWAYS_INLINE unsigned cull(const Node& node, Limit limit, Keys keys) const {
        return slab_test(node, ray_lanes, limit, keys);
    }
    template <class SomeAnswer>
    ESPALIER_ALWAYS_INLINE Visit scan(const PlaceOf<Leaf>& place, SomeAnswer& answer, QueryCounters* counters) const {
        RayLeaf<Leaf> leaf;
        auto candidates = ray_candidates(*place.blob, place.node, place.number, ray, leaf);
        if (counters != nullptr) {
            counters->count_leaf(leaf.triangle_count());
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
    const TriangleFilter& filter;
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
        if (filter && !filter(TriangleId{index})) return Visit::next;
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
    const TriangleFilter& filter;
    Limit limit;

    template <class Leaf>
    ESPALIER_PART_OF_CALLER Visit decide(const LatticeRay& ray, const Leaf& leaf, unsigned slot) {
        TriangleHit hit;
        if (!hits_slot(leaf, slot, ray, hit)) return Visit::next;
        const std::uint32_t index = owner_index(leaf, slot);
        if constexpr (Leaf::may_have_duplicates)
            if (hits.has(*leaf.blob, index)) return Visit::next;
        if (filter && !filter(TriangleId{index})) return Visit::next;
        hits.offer(to_ray_hit(hit, index));
        if (!hits.has_overflowed()) return Visit::next;
        if (hits.is_empty()) return Visit::stop;
        limit = hit_limit(ray, hits.largest_key());
        return Visit::next;
    }
};

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
    const TriangleFilter& filter;

    template <class Leaf>
    ESPALIER_PART_OF_CALLER Visit decide(const LatticeRay& ray, const Leaf& leaf, unsigned slot) const {
        TriangleHit hit;
        if (!hits_slot(leaf, slot, ray, hit)) return Visit::next;
        return !filter || filter(TriangleId{owner_index(leaf, slot)}) ? Visit::stop : Visit::next;
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

ESPALIER_END_SET

#endif
