// Queries of two blobs where code is dearer than time: one visitor for contacts and distances, which takes the
// triangles of two leaves pair by pair. The nodes that it opens are those that lanes would: work limits end at the same
// pair.
#include <bit>

#include <runtime/pair_queries.hpp>
#include <runtime/scalar_walk.hpp>

#if ESPALIER_SMALL_CODE

namespace espalier::detail::scalar {

#include <runtime/with_leaves_of.inl>
#include <runtime/pair_nodes.inl>
#include <runtime/pair_trees.inl>
#include <runtime/pair_beam.inl>
#include <runtime/small_pair_walk.inl>
#include <runtime/least_distance.inl>
#include <runtime/pair_leaves.inl>
#include <runtime/pair_near.inl>

namespace {

PlacedLanes lanes_of(const LatticeTriangle& triangle) {
    PlacedLanes placed;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) placed.corner[i][k] = static_cast<float>(triangle.corner[i][k]);
    placed.derive_box();
    return placed;
}

[[gnu::noinline]] float squared_gap_to(const PlacedBox& box, const LatticeTriangle& triangle) {
    return squared_gap(lanes_of(triangle), box.low, box.high);
}

/// The squared distance of the nearest corners, unless shadows along the directions are farther apart than the limit:
/// as in pair_near.inl.
[[gnu::noinline]] float squared_between_corners(const LatticeTriangle& a, const LatticeTriangle& b,
                                                const PairAxes& axes, float limit) {
    const PlacedLanes t = lanes_of(a), other = lanes_of(b);
    if (!(gap_along_axes(t, other, axes) <= limit)) return infinity;
    return squared_of_nearest_corners(t, other);
}

/// A triangle of each of two leaves, on the grid: b's in storage order, for each of them a's. Finding the next pair
/// takes its stack while nobody looks at one.
template <class LeafA, class LeafB>
struct SlotPair {
    const PairFrame& frame;
    const LeafA& a_leaf;
    const LeafB& b_leaf;
    typename LeafA::Slots a_slots;  ///< that are still to come beside b
    typename LeafB::Slots b_slots;
    unsigned a_slot, b_slot;
    LatticeTriangle a, b;

    SlotPair(const PairFrame& on_grid, const LeafA& leaf, const LeafB& other)
        : frame(on_grid), a_leaf(leaf), b_leaf(other) {}
    void begin() {
        a_slots = 0;
        b_slots = b_leaf.used_slots();
    }
    void place_a(unsigned slot) {
        a_slot = slot;
        a = frame.place_a(a_leaf.triangle(slot));
    }
    void place_b(unsigned slot) {
        b_slot = slot;
        b = frame.place_b(b_leaf.triangle(slot));
    }
    /// The next whose boxes are within the squared distance, b's also of a box around all of a. False when there is
    /// none.
    [[gnu::noinline]] bool next(const PlacedBox& box, float limit) {
        for (;;) {
            while (a_slots != 0) {
                place_a(static_cast<unsigned>(std::countr_zero(a_slots)));
                a_slots &= a_slots - 1;
                if (!(gap_between(a, b) > limit)) return true;
            }
            if (b_slots == 0) return false;
            place_b(static_cast<unsigned>(std::countr_zero(b_slots)));
            b_slots &= b_slots - 1;
            if (!(squared_gap_to(box, b) > limit)) a_slots = a_leaf.used_slots();
        }
    }
};

[[gnu::noinline]] bool do_triangles_meet(const LatticeTriangle& a, const LatticeTriangle& b) {
    return triangles_meet(integer_triangle(a), integer_triangle(b));
}

/// Contacts, or the least distance: whichever is there.
struct PairVisitor {
    const PairFrame& frame;
    const OnTouching* on_touching = nullptr;
    LeastDistance* least = nullptr;

    [[nodiscard]] float limit() const { return least != nullptr ? least->limit() : 0.0f; }

    template <class Node>
    [[gnu::noinline]] unsigned children(unsigned side, const Node& node, const TwiceBox& other, float* keys) const {
        const PairSide& view = frame.sides[side];
        const BlobData& blob = side == 0 ? *frame.a : *frame.b;
        const SeenBox seen = see_box(other, view);
        static constexpr PairAxes no_axes;
        const float unit = view.common_size;
        return children_near_if(least == nullptr, node, blob, seen, view,
                                least != nullptr ? least->axes(side) : no_axes,
                                least != nullptr ? least->limit_ / (unit * unit) : 0.0f, keys);
    }

    Visit visit_leaves(PairLeaf a_place, PairLeaf b_place, const TwiceBox& a_box) const {
        return scalar_walk::with_leaves_of(*frame.a, [&]<class LeafA>() {
            return scalar_walk::with_leaves_of(*frame.b, [&]<class LeafB>() {
                const auto a = leaf_of_pair<LeafA>(frame, 0, a_place);
                const auto b = leaf_of_pair<LeafB>(frame, 1, b_place);
                const PlacedBox box(a_box, frame);
                SlotPair<LeafA, LeafB> pair(frame, a, b);
                return least != nullptr ? visit_near(pair, box) : visit_touching(pair, box);
            });
        });
    }

private:
    template <class Pair>
    [[gnu::noinline]] Visit visit_touching(Pair& pair, const PlacedBox& box) const {
        for (pair.begin(); pair.next(box, 0.0f);)
            if (do_triangles_meet(pair.a, pair.b) &&
                (*on_touching)(
                    {{storage_index(pair.a_leaf, pair.a_slot)}, {storage_index(pair.b_leaf, pair.b_slot)}}) == stop)
                return stop;
        return keep_going;
    }
    /// First what corners tell: how far apart the leaves are at most, and which pair is a good one to begin with.
    template <class Pair>
    [[gnu::noinline]] Visit visit_near(Pair& pair, const PlacedBox& box) const {
        NearestCorners nearest;
        for (pair.begin(); pair.next(box, least->limit());) {
            nearest.offer(squared_between_corners(pair.a, pair.b, least->axes(0), least->limit()),
                          pair.b_slot * NearestCorners::a_slots + pair.a_slot);
            least->lower_limit(nearest.squared * lower_slack);
        }
        if (!(nearest.squared < infinity)) return keep_going;
        pair.place_a(nearest.a_slot());
        pair.place_b(nearest.b_slot());
        if (decide(pair) == stop) return stop;
        if (least->surveys) return keep_going;
        for (pair.begin(); pair.next(box, least->limit());)
            if (decide(pair) == stop) return stop;
        return keep_going;
    }
    template <class Pair>
    Visit decide(const Pair& pair) const {
        return least->visit_pair(pair.a, pair.b, [&] {
            return TrianglePair{{owner_index(pair.a_leaf, pair.a_slot)}, {owner_index(pair.b_leaf, pair.b_slot)}};
        });
    }
};

}  // namespace

QueryStatus touching_pairs(const PairFrame& frame, OnTouching visit, std::uint64_t& work) {
    PairVisitor visitor = {frame, &visit, nullptr};
    return traverse_pair(frame, visitor, work);
}

QueryStatus nearest_pair(const PairFrame& frame, float radius, bool any, FoundTriangles& best, bool& found,
                         std::uint64_t& work) {
    LeastDistance least = {frame, best, radius, any};
    PairVisitor visitor = {frame, nullptr, &least};
    const QueryStatus status = search_nearest(frame, visitor, least, work);
    found = least.found;
    return status;
}

}  // namespace espalier::detail::scalar

#endif
