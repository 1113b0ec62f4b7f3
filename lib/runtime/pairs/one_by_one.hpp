// The triangles of two leaves pair by pair, where small code matters more than time.
#ifndef ESPALIER_PAIRS_ONE_BY_ONE_HPP
#define ESPALIER_PAIRS_ONE_BY_ONE_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/pairs/corners.hpp>

ESPALIER_BEGIN_SET

inline PlacedLanes lanes_of(const LatticeTriangle& triangle) {
    PlacedLanes placed;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) placed.corner[i][k] = static_cast<float>(triangle.corner[i][k]);
    return placed;
}

/// The squared distance of the nearest corners, unless shadows along the directions are farther apart than the limit:
/// as in near.hpp.
ESPALIER_NOINLINE inline float squared_between_corners(const LatticeTriangle& a, const LatticeTriangle& b,
                                                       const PairAxes& axes, float limit) {
    const PlacedLanes t = lanes_of(a), other = lanes_of(b);
    if (!(gap_along_axes(t, other, axes) <= limit)) return infinity;
    return squared_of_nearest_corners(t, other);
}

/// A triangle of each of two leaves, on the grid: b's in storage order, for each of them a's. Finding the next pair
/// takes its stack while nobody looks at one.
template <class Leaves>
struct SlotPair {
    const Leaves& leaves;
    typename Leaves::A::Slots a_slots = 0;  ///< that are still to come beside b
    typename Leaves::B::Slots b_slots = leaves.b.used_slots();
    bool touching;
    std::uint8_t a_slot, b_slot;
    LatticeTriangle a, b;

    SlotPair(const Leaves& of, bool only_touching) : leaves(of), touching(only_touching) {}
    void place_a(unsigned slot) {
        a_slot = static_cast<std::uint8_t>(slot);
        a = leaves.triangle_a(slot);
    }
    void place_b(unsigned slot) {
        b_slot = static_cast<std::uint8_t>(slot);
        b = leaves.triangle_b(slot);
    }
    /// The next whose boxes are within the squared distance, b's also of a box around all of a. False when there is
    /// none.
    ESPALIER_NOINLINE bool next(float limit) {
        for (;;) {
            while (a_slots != 0) {
                place_a(static_cast<unsigned>(std::countr_zero(a_slots)));
                a_slots &= a_slots - 1;
                if (!(gap_between(a, b) > limit)) return true;
            }
            if (b_slots == 0) return false;
            place_b(static_cast<unsigned>(std::countr_zero(b_slots)));
            b_slots &= b_slots - 1;
            place_box_of_a();
            if (gap_between(a, b) > limit) continue;
            if (!touching || lanes_near(lanes_of(b).corner, leaves.box, true, limit) != 0)
                a_slots = leaves.a.used_slots();
        }
    }

private:
    /// In the place of a triangle of a, since none is needed then. Integers take a fraction of the time of floats.
    void place_box_of_a() {
        for (int k = 0; k < 3; ++k) {
            a.corner[0][k] = static_cast<std::int32_t>(leaves.box.low[k]) - 1;
            a.corner[1][k] = a.corner[2][k] = static_cast<std::int32_t>(leaves.box.high[k]) + 1;
        }
    }
};

template <class Leaves>
ESPALIER_NOINLINE Visit visit_touching(const Leaves& leaves, const OnTouching& visit) {
    SlotPair pair(leaves, true);
    const auto place_both = [&pair](LatticeTriangle& of_a, LatticeTriangle& of_b) {
        of_a = pair.a;
        of_b = pair.b;
    };
    while (pair.next(0.0f))
        if (triangles_meet(pair.a, pair.b) && visit(leaves.at(pair.a_slot, pair.b_slot), place_both) == Visit::stop)
            return Visit::stop;
    return Visit::next;
}

/// First what corners tell: how far apart the leaves are at most, and which pair is a good one to begin with.
template <class Leaves>
ESPALIER_NOINLINE Visit visit_near(const Leaves& leaves, LeastDistance& least) {
    NearestCorners nearest;
    SlotPair pair(leaves, false);
    while (pair.next(least.limit())) {
        nearest.offer(squared_between_corners(pair.a, pair.b, least.axes[0], least.limit()),
                      pair.b_slot * NearestCorners::a_slots + pair.a_slot);
        least.lower_limit(nearest.squared * lower_slack);
    }
    if (!(nearest.squared < infinity)) return Visit::next;
    pair.place_a(nearest.a_slot());
    pair.place_b(nearest.b_slot());
    pair.b_slots = leaves.b.used_slots();
    do {
        if (least.take(pair.a, pair.b, leaves.at(pair.a_slot, pair.b_slot)) == Visit::stop) return Visit::stop;
    } while (!least.surveys && pair.next(least.limit()));
    return Visit::next;
}

ESPALIER_END_SET

#endif
