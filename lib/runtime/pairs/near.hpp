// Which triangles of two leaves are within a distance of each other, in lanes: these only reject.
#ifndef ESPALIER_PAIRS_NEAR_HPP
#define ESPALIER_PAIRS_NEAR_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/pairs/corners.hpp>

ESPALIER_BEGIN_SET

/// Which of the triangles may be within the squared distance of the column's. The corners also tell how far apart these
/// are at most, and the limit comes down to that.
ESPALIER_NOINLINE inline unsigned match_near(const PlacedLanes& t, const PlacedColumns& others, unsigned column,
                                             unsigned used, const PairAxes& axes, float& limit,
                                             NearestCorners& nearest_corners, unsigned first_pair) {
    PlacedLanes other;
    other.spread(others, column);
    other.derive_box();
    unsigned near = at_most(squared_gap(t, other.low, other.high), splat(limit)) & used;
    if (near == 0) return 0;
    near &= at_most(gap_along_axes(t, other, axes), splat(limit));
    if (near == 0) return 0;
    float at_most_apart[lanes];
    store(at_most_apart, squared_of_nearest_corners(t, other));
    for (unsigned rest = near; rest != 0; rest &= rest - 1) {
        const auto lane = static_cast<unsigned>(std::countr_zero(rest));
        nearest_corners.offer(at_most_apart[lane], first_pair + lane);
    }
    limit = minimum(nearest_corners.squared * lower_slack, limit);
    const Floats bound = splat(limit * lower_slack);
    // From boxes within the limit of each other: distances along an axis are longer by its root.
    other.derive_plane();
    const Floats small = multiply(add(add(t.size, other.size), splat(square_root(limit))), splat(volume_slack));
    const auto is_near_plane = [&](const PlacedLanes& from, const PlacedLanes& plane) {
        Floats distances[3];
        distances_from_plane(from, plane, distances);
        const Floats rounding = multiply(multiply(plane.size, plane.size), small);
        const Floats far_off = larger(subtract(separation(distances), rounding), splat(0.0f));
        const Floats* n = plane.normal;
        const Floats length = add(add(multiply(n[0], n[0]), multiply(n[1], n[1])), multiply(n[2], n[2]));
        return at_most(multiply(far_off, far_off), multiply(bound, length));
    };
    near &= is_near_plane(t, other);
    return near == 0 ? 0 : near & is_near_plane(other, t);
}

/// The triangles of a leaf of a that may be within the squared distance of each of the columns.
template <class Leaf>
ESPALIER_NOINLINE void match_near(const Leaf& leaf, const PairFrame& frame, const PlacedColumns& others, unsigned near,
                                  const PairAxes& axes, float& limit, NearestCorners& nearest,
                                  typename Leaf::Slots* slots) {
    for (unsigned rest = near; rest != 0; rest &= rest - 1) slots[std::countr_zero(rest)] = 0;
    for_lanes_and_columns(leaf, frame, near, [&](const PlacedLanes& t, unsigned first, unsigned column, unsigned used) {
        const unsigned first_pair = (nearest.first_column + column) * NearestCorners::a_slots + first;
        slots[column] |= typename Leaf::Slots{match_near(t, others, column, used, axes, limit, nearest, first_pair)}
                         << first;
    });
}

template <class Leaves>
ESPALIER_NOINLINE Visit take_exactly(const Leaves& leaves, unsigned a_slot, unsigned b_slot, LeastDistance& least) {
    return least.take(leaves.triangle_a(a_slot), leaves.triangle_b(b_slot), leaves.at(a_slot, b_slot));
}

/// Hands on the triangles of two leaves that may be within the limit of each other.
template <class Leaves>
ESPALIER_NOINLINE Visit visit_near(const Leaves& leaves, LeastDistance& least) {
    using Slots = typename Leaves::A::Slots;
    const auto& b = leaves.b;
    auto corners = corners_of(b);
    const auto visit = [&](unsigned a_slot, unsigned b_slot) { return take_exactly(leaves, a_slot, b_slot, least); };
    NearestCorners nearest;
    for (unsigned first = 0; first < b.slot_count; first += columns) {
        PlacedColumns others;
        const float limit_before = least.limit();
        unsigned near = place_columns(b, leaves.frame, first, corners, leaves.box, false, limit_before, others);
        if (near == 0) continue;
        Slots slots[columns];
        const auto match_all = [&] {
            float limit = least.limit();
            match_near(leaves.a, leaves.frame, others, near, least.axes[0], limit, nearest, slots);
            least.lower_limit(limit);
        };
        nearest.first_column = first;
        match_all();
        if (least.surveys) continue;
        // The most promising pair first: what it finds rules most of the others out.
        if (const unsigned column = nearest.b_slot() - first; nearest.squared < infinity && column < columns) {
            const auto bit = Slots{1} << nearest.a_slot();
            if ((slots[column] & bit) != 0) {
                if (visit(nearest.a_slot(), nearest.b_slot()) == Visit::stop) return Visit::stop;
                if (least.limit() < limit_before) match_all();
                slots[column] &= ~bit;
            }
        }
        for (; near != 0; near &= near - 1) {
            const auto column = static_cast<unsigned>(std::countr_zero(near));
            for (auto mask = slots[column]; mask != 0; mask &= mask - 1)
                if (visit(static_cast<unsigned>(std::countr_zero(mask)), first + column) == Visit::stop)
                    return Visit::stop;
        }
    }
    return least.surveys && nearest.squared < infinity ? visit(nearest.a_slot(), nearest.b_slot()) : Visit::next;
}

ESPALIER_END_SET

#endif
