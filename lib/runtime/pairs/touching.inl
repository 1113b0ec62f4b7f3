// Which triangles of two leaves touch, in lanes: what rounding cannot change is decided here, the rest is left to the
// kernel (triangle_triangle.hpp), whose way this is.
#ifndef ESPALIER_IN_INSTRUCTION_SET  // parsed alone
#include <runtime/pairs/leaves.inl>
#endif

/// Triangles turned so that the corner comes first that is alone on its side of the others' planes.
struct TurnedLanes {
    Floats a[3], b[3], c[3];
    Floats distance;  ///< of corner a from the plane

    TurnedLanes(const Floats (*corner)[3], const Floats* distances) {
        const Floats zero = splat(0.0f);
        const Floats last_two = multiply(distances[1], distances[2]), outer = multiply(distances[0], distances[2]);
        const auto pick = [&](Floats x, Floats y, Floats z) {
            return where_at_most(zero, last_two, x, where_at_most(zero, outer, y, z));
        };
        for (int k = 0; k < 3; ++k) {
            a[k] = pick(corner[0][k], corner[1][k], corner[2][k]);
            b[k] = pick(corner[1][k], corner[2][k], corner[0][k]);
            c[k] = pick(corner[2][k], corner[0][k], corner[1][k]);
        }
        distance = pick(distances[0], distances[1], distances[2]);
    }
};

/// How far both ends of p's part of the line that the planes share are from being on the wrong side of q's: below zero
/// where the triangles meet, above where not.
inline Floats distance_on_line(const TurnedLanes& p, const TurnedLanes& q) {
    const Floats zero = splat(0.0f);
    const Floats alike = multiply(p.distance, q.distance);
    Floats between[3], to_first[3], to_second[3];
    for (int k = 0; k < 3; ++k) {
        between[k] = subtract(q.a[k], p.a[k]);
        to_first[k] = subtract(where_at_most(zero, alike, q.b[k], q.c[k]), q.a[k]);
        to_second[k] = subtract(where_at_most(zero, alike, q.c[k], q.b[k]), q.a[k]);
    }
    Floats normal[3];
    PlacedLanes::cross(between, to_first, normal);
    const Floats first = distance_along(p.a, p.b, normal);
    PlacedLanes::cross(between, to_second, normal);
    const Floats second = distance_along(p.a, p.c, normal);
    return where_at_most(zero, q.distance, larger(first, negate(second)), larger(negate(first), second));
}

/// The triangles of the lanes that may touch the one of the column; `certain` are those that do.
inline unsigned match_touching(const PlacedLanes& t, const PlacedColumns& others, unsigned column, unsigned used,
                               unsigned& certain) {
    certain = 0;
    PlacedLanes other;
    other.spread(others, column);
    other.derive_box();
    unsigned near = at_most(squared_gap(t, other.low, other.high), splat(0.0f)) & used;
    if (near == 0) return 0;
    other.derive_plane();
    const Floats small = multiply(add(t.size, other.size), splat(volume_slack));
    const Floats their_slack = multiply(multiply(other.size, other.size), small);
    const Floats our_slack = multiply(multiply(t.size, t.size), small);
    const Floats slack = multiply(multiply(t.size, other.size), small);
    Floats ours_off[3], theirs_off[3];
    distances_from_plane(t, other, ours_off);
    near &= at_most(separation(ours_off), their_slack);
    if (near == 0) return 0;
    distances_from_plane(other, t, theirs_off);
    near &= at_most(separation(theirs_off), our_slack);
    // A core with one lane has no better use for its time than the kernel itself.
    if (near == 0 || lanes == 1) return near;
    const auto nearest = [](const Floats* off) {
        return least(magnitude(off[0]), magnitude(off[1]), magnitude(off[2]));
    };
    const unsigned in_doubt = at_most(nearest(ours_off), their_slack) | at_most(nearest(theirs_off), our_slack);
    const Floats distance = distance_on_line(TurnedLanes(t.corner, ours_off), TurnedLanes(other.corner, theirs_off));
    near &= at_most(distance, slack) | in_doubt;
    certain = near & at_most(distance, negate(slack)) & ~in_doubt;
    return near;
}

template <class Slots>
struct TouchingSlots {
    Slots may[columns];
    Slots certain[columns];
};

/// The triangles of a leaf of a that may touch each of the columns, or surely do.
template <class Leaf>
[[gnu::noinline]] void match_touching(const Leaf& leaf, const PairFrame& frame, const PlacedColumns& others,
                                      unsigned near, TouchingSlots<typename Leaf::Slots>& slots) {
    for (unsigned rest = near; rest != 0; rest &= rest - 1)
        slots.may[std::countr_zero(rest)] = slots.certain[std::countr_zero(rest)] = 0;
    for_lanes_and_columns(leaf, frame, near, [&](const PlacedLanes& t, unsigned first, unsigned column, unsigned used) {
        unsigned certain = 0;
        slots.may[column] |= typename Leaf::Slots{match_touching(t, others, column, used, certain)} << first;
        slots.certain[column] |= typename Leaf::Slots{certain} << first;
    });
}

template <class Leaves>
[[gnu::noinline]] bool touch_exactly(const Leaves& leaves, unsigned a_slot, unsigned b_slot) {
    return triangles_meet(leaves.triangle_a(a_slot), leaves.triangle_b(b_slot));
}

/// Calls visit with the storage indices of each pair of triangles of the leaves that touches: b's in storage order, for
/// each of them a's.
template <class Leaves>
[[gnu::noinline]] Visit visit_touching(const Leaves& leaves, OnTouching visit) {
    const auto& b = leaves.b;
    auto corners = corners_of(b);
    for (unsigned first = 0; first < b.slot_count; first += columns) {
        PlacedColumns others;
        unsigned near = place_columns(b, leaves.frame, first, corners, leaves.box, true, 0.0f, others);
        if (near == 0) continue;
        TouchingSlots<typename Leaves::A::Slots> slots;
        match_touching(leaves.a, leaves.frame, others, near, slots);
        for (; near != 0; near &= near - 1) {
            const auto column = static_cast<unsigned>(std::countr_zero(near));
            for (auto may = slots.may[column]; may != 0; may &= may - 1) {
                const auto slot = static_cast<unsigned>(std::countr_zero(may));
                if ((slots.certain[column] >> slot & 1u) == 0 && !touch_exactly(leaves, slot, first + column)) continue;
                if (visit(leaves.at(slot, first + column)) == Visit::stop) return Visit::stop;
            }
        }
    }
    return Visit::next;
}
