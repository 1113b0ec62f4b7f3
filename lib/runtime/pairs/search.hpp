// Two blobs: what an instruction set does at each step, and the search for touching pairs or for the least distance.
#ifndef ESPALIER_PAIRS_SEARCH_HPP
#define ESPALIER_PAIRS_SEARCH_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/pairs/beam.hpp>
#if ESPALIER_SMALL_CODE
#include <runtime/pairs/one_by_one.hpp>
#else
#include <runtime/pairs/near.hpp>
#include <runtime/pairs/touching.hpp>
#endif

ESPALIER_BEGIN_SET

template <class Leaf>
inline bool has_reference(const BlobData& blob, const Leaf& leaf, TriangleId triangle) {
    for (auto slots = leaf.used_slots(); slots != 0; slots &= slots - 1)
        if (owner_of(blob, storage_index(leaf, static_cast<unsigned>(std::countr_zero(slots)))) == triangle.index)
            return true;
    return false;
}

/// Whether the nearest pair is searched for with these lanes. The tests of a pair of leaves, which take most of the
/// time, fill at most eight: sixteen would be idle for the most part and take twice the stack.
inline constexpr bool searches_nearest = lanes <= 8;

struct PairVisitor {
    const PairFrame& frame;
    const PairSearch& search;
#if !ESPALIER_SMALL_CODE
    PlacedLeaves* placed;  ///< of a search for all pairs that touch
    DecodedLeaf decoded[2] = {};
#endif

    template <class Node>
    unsigned children(unsigned side, const Node& node, const TwiceBox& other, float* keys) const {
        const LeastDistance* least = search.least;
        const PairSide& view = frame.sides[side];
        const float unit = view.common_size;
        const float limit = least != nullptr ? least->limit_of_boxes / (unit * unit) : 0.0f;
        const unsigned near = children_near(node, frame.blob(side), see_box(other, view), view,
                                            least != nullptr ? &least->axes[side] : nullptr, limit, keys);
        if (!reads_duplicate_references || search.only == nullptr) return near;
        return near & children_within(node, frame.blob(side).bits, search.only->bounds[side]);
    }
    ESPALIER_PART_OF_CALLER Visit visit_leaves(PairLeaf a, PairLeaf b, const TwiceBox& a_box) {
        return with_leaves_of(*frame.a, [&]<class LeafA>() ESPALIER_ALWAYS_INLINE_LAMBDA {
            return with_leaves_of(*frame.b, [&]<class LeafB>() ESPALIER_ALWAYS_INLINE_LAMBDA {
                return visit_leaves_of<LeafA, LeafB>(a, b, a_box);
            });
        });
    }

private:
    /// Apart, so that it takes no room of the frame of a search that counts nothing.
    template <class Leaves>
    ESPALIER_NOINLINE void count(const Leaves& leaves) const {
        search.counters->count_leaves(leaves.a.triangle_count(), leaves.b.triangle_count());
    }
    template <class LeafA, class LeafB>
    ESPALIER_PART_OF_CALLER Visit visit_leaves_of(PairLeaf a, PairLeaf b, const TwiceBox& a_box) {
#if ESPALIER_SMALL_CODE
        const LeafPair<LeafA, LeafB> leaves(frame, a, b, a_box);
#else
        const LeafPair<LeafA, LeafB> leaves(frame, decoded, a, b, a_box);
#endif
        if (reads_duplicate_references && search.only != nullptr &&
            !(has_reference(*frame.a, leaves.a, search.only->triangles.a) &&
              has_reference(*frame.b, leaves.b, search.only->triangles.b)))
            return Visit::next;
        if (search.counters != nullptr) count(leaves);
        if constexpr (searches_nearest)
            if (search.least != nullptr) return visit_near(leaves, *search.least);
#if ESPALIER_SMALL_CODE
        return visit_touching(leaves, search.on_touching);
#else
        return visit_touching(leaves, *placed, search.on_touching);
#endif
    }
};

#if !ESPALIER_SMALL_CODE
/// Out of line: a search for the nearest pair has no use for placed leaves.
ESPALIER_NOINLINE inline QueryStatus search_touching(const PairFrame& frame, const PairSearch& search,
                                                     std::uint64_t& work) {
    PlacedLeaves placed;
    PairVisitor visitor = {frame, search, &placed};
    return walk_pair(frame, visitor, search.from, work);
}
#endif

ESPALIER_QUERY_OF_SET QueryStatus search_pairs(const PairFrame& frame, const PairSearch& search,
                                               std::uint64_t& work) noexcept {
#if ESPALIER_SMALL_CODE
    PairVisitor visitor = {frame, search};
    return search.least != nullptr ? search_nearest(frame, visitor, *search.least, work)
                                   : walk_pair(frame, visitor, search.from, work);
#elif ESPALIER_LANES == 16
    return search.least == nullptr ? search_touching(frame, search, work) : avx2::search_pairs(frame, search, work);
#else
    if (search.least == nullptr) return search_touching(frame, search, work);
    PairVisitor visitor = {frame, search, nullptr};
    return search_nearest(frame, visitor, *search.least, work);
#endif
}

ESPALIER_END_SET

#endif
