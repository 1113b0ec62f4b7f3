// Queries of two blobs where code is dearer than time: one visitor for contacts and distances, which takes the
// triangles of two leaves pair by pair. The nodes that it opens are those that lanes would: work limits end at the same
// pair.
#include <bit>

#include <runtime/pair_queries.hpp>
#include <runtime/scalar_walk.hpp>

#if ESPALIER_SMALL_CODE

namespace espalier::detail::scalar {

#include <runtime/pair_nodes.inl>
#include <runtime/traverse_pair.inl>
#include <runtime/pair_beam.inl>
#include <runtime/least_distance.inl>
#include <runtime/pair_leaves.inl>
#include <runtime/pair_near.inl>

namespace {

/// A triangle of each leaf, on the grid, and its slot.
struct SlotPair {
    unsigned a_slot, b_slot;
    LatticeTriangle a, b;
};
using OnSlotPair = FunctionRef<Visit(const SlotPair&)>;

PlacedLanes lanes_of(const LatticeTriangle& triangle) {
    PlacedLanes placed;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) placed.corner[i][k] = static_cast<float>(triangle.corner[i][k]);
    placed.derive_box();
    return placed;
}

/// The squared distance of the nearest corners, unless boxes, or shadows along the directions, are farther apart than
/// the limit: as in pair_near.inl.
[[gnu::noinline]] float squared_between_corners(const SlotPair& pair, const PairAxes& axes, float limit) {
    const PlacedLanes t = lanes_of(pair.a), other = lanes_of(pair.b);
    if (!(gap_along_axes(t, other, axes) <= limit)) return infinity;
    return squared_of_nearest_corners(t, other);
}

[[gnu::noinline]] float squared_gap_to(const PlacedBox& box, const LatticeTriangle& triangle) {
    return squared_gap(lanes_of(triangle), box.low, box.high);
}

/// Contacts, or the least distance: whichever is there.
struct PairVisitor {
    const PairFrame& frame;
    const OnTouching* on_touching = nullptr;
    LeastDistance* least = nullptr;

    [[nodiscard]] float limit() const { return least != nullptr ? least->limit() : 0.0f; }

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

    Visit visit_leaves(const LeafPlace& a_place, const LeafPlace& b_place) const {
        return scalar_walk::with_leaves_of(*frame.a, [&]<class LeafA>() {
            return scalar_walk::with_leaves_of(*frame.b, [&]<class LeafB>() {
                const auto a = leaf_at<LeafA>(*frame.a, a_place.node, a_place.number);
                const auto b = leaf_at<LeafB>(*frame.b, b_place.node, b_place.number);
                const PlacedBox box(a_place.box, frame);
                return least != nullptr ? visit_near(a, b, box) : visit_touching(a, b, box);
            });
        });
    }

private:
    /// b's triangles in storage order, for each of them a's; those whose boxes are within the limit.
    template <class LeafA, class LeafB>
    [[gnu::noinline]] Visit for_each_pair(const LeafA& a, const LeafB& b, const PlacedBox& box,
                                          OnSlotPair visit) const {
        SlotPair pair;
        for (auto b_slots = b.used_slots(); b_slots != 0; b_slots &= b_slots - 1) {
            pair.b_slot = static_cast<unsigned>(std::countr_zero(b_slots));
            pair.b = frame.place_b(b.triangle(pair.b_slot));
            if (squared_gap_to(box, pair.b) > limit()) continue;
            for (auto a_slots = a.used_slots(); a_slots != 0; a_slots &= a_slots - 1) {
                pair.a_slot = static_cast<unsigned>(std::countr_zero(a_slots));
                pair.a = frame.place_a(a.triangle(pair.a_slot));
                if (gap_between(pair.a, pair.b) > limit()) continue;
                if (visit(pair) == stop) return stop;
            }
        }
        return keep_going;
    }
    template <class LeafA, class LeafB>
    [[gnu::noinline]] Visit visit_touching(const LeafA& a, const LeafB& b, const PlacedBox& box) const {
        return for_each_pair(a, b, box, [&](const SlotPair& pair) {
            if (!triangles_meet(integer_triangle(pair.a), integer_triangle(pair.b))) return keep_going;
            return (*on_touching)({{storage_index(a, pair.a_slot)}, {storage_index(b, pair.b_slot)}});
        });
    }
    /// First what corners tell: how far apart the leaves are at most, and which pair is a good one to begin with.
    template <class LeafA, class LeafB>
    [[gnu::noinline]] Visit visit_near(const LeafA& a, const LeafB& b, const PlacedBox& box) const {
        NearestCorners nearest;
        for_each_pair(a, b, box, [&](const SlotPair& pair) {
            nearest.offer(squared_between_corners(pair, least->axes(0), least->limit()),
                          pair.b_slot * NearestCorners::a_slots + pair.a_slot);
            least->lower_limit(nearest.squared * lower_slack);
            return keep_going;
        });
        if (!(nearest.squared < infinity)) return keep_going;
        if (decide_nearest(a, b, nearest) == stop) return stop;
        if (least->surveys) return keep_going;
        return for_each_pair(a, b, box, [&](const SlotPair& pair) { return decide(a, b, pair); });
    }
    template <class LeafA, class LeafB>
    Visit decide(const LeafA& a, const LeafB& b, const SlotPair& pair) const {
        return least->visit_pair(pair.a, pair.b, [&] {
            return TrianglePair{{owner_index(a, pair.a_slot)}, {owner_index(b, pair.b_slot)}};
        });
    }
    template <class LeafA, class LeafB>
    [[gnu::noinline]] Visit decide_nearest(const LeafA& a, const LeafB& b, const NearestCorners& nearest) const {
        const unsigned a_slot = nearest.a_slot(), b_slot = nearest.b_slot();
        return decide(a, b, {a_slot, b_slot, frame.place_a(a.triangle(a_slot)), frame.place_b(b.triangle(b_slot))});
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
