// Which triangles of two leaves touch, in lanes: what rounding cannot change is decided here, the rest is left to the
// kernel (triangle_triangle.hpp), whose way this is.
#ifndef ESPALIER_PAIRS_TOUCHING_HPP
#define ESPALIER_PAIRS_TOUCHING_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/pairs/placed.hpp>

ESPALIER_BEGIN_SET

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

/// Returns how far apart the intervals are that p and q cover on the line that their planes share: below zero where
/// they overlap, so that the triangles meet, and above where they do not.
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

/// Pairs of triangles of two leaves, one in each lane, by their places among those that are placed.
struct PairsInLanes {
    static constexpr unsigned most = lanes;
    std::uint8_t a[most] = {};
    std::uint8_t b[most] = {};
    unsigned count = 0;
};

/// The pairs whose triangles may touch; `certain` are those that do. Their boxes meet.
ESPALIER_NOINLINE inline unsigned match_pairs(const PlacedTriangles& of_a, const PlacedTriangles& of_b,
                                              const PairsInLanes& pairs, unsigned& certain) {
    certain = 0;
    PlacedLanes t = of_a.some(load_numbers(reinterpret_cast<const std::byte*>(pairs.a)));
    t.derive_box();
    t.derive_plane();
    PlacedLanes other = of_b.some(load_numbers(reinterpret_cast<const std::byte*>(pairs.b)));
    other.derive_box();
    other.derive_plane();
    const Floats small = multiply(add(t.size, other.size), splat(volume_slack));
    const Floats their_slack = multiply(multiply(other.size, other.size), small);
    const Floats our_slack = multiply(multiply(t.size, t.size), small);
    const Floats slack = multiply(multiply(t.size, other.size), small);
    Floats ours_off[3], theirs_off[3];
    distances_from_plane(t, other, ours_off);
    unsigned near = at_most(separation(ours_off), their_slack) & ((1u << pairs.count) - 1u);
    if (lanes == 1 && near == 0) return 0;
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

/// Which triangles of a have boxes that meet those of b's that are near: 16 bits for each of these, in words, so that
/// one loop goes through the pairs of several.
struct MeetingBoxes {
    static constexpr unsigned bits = PlacedTriangles::most, in_word = 64 / bits;
    static_assert(bits == 16);

    std::uint64_t words[PlacedTriangles::most / in_word] = {};
    std::uint8_t place[PlacedTriangles::most];  ///< of each one of b
    unsigned count;

    explicit MeetingBoxes(unsigned near) : count(0) {
        for (; near != 0; near &= near - 1) place[count++] = static_cast<std::uint8_t>(std::countr_zero(near));
    }
    ESPALIER_NOINLINE void find(const PlacedTriangles& of_a, unsigned used, const PlacedTriangles& of_b) {
        for (unsigned group = 0; group < PlacedTriangles::groups; ++group) {
            const unsigned used_lanes = used >> group * lanes & ((1u << lanes) - 1u);
            if (used_lanes == 0) continue;  // of a strip, others may follow
            PlacedLanes t = of_a.group(group);
            t.derive_box();
            for (unsigned i = 0; i < count; ++i) {
                PlacedLanes other;
                other.spread(of_b, place[i]);
                other.derive_box();
                Floats apart = splat(-infinity);
                for (int k = 0; k < 3; ++k)
                    apart = larger(larger(subtract(t.low[k], other.high[k]), subtract(other.low[k], t.high[k])), apart);
                const std::uint64_t met = at_most(apart, splat(0.0f)) & used_lanes;
                words[i / in_word] |= met << (i % in_word * bits + group * lanes);
            }
        }
    }
};

/// For each triangle of b, the triangles of a that may touch it and those that certainly do: a bit for each slot.
template <class Slots>
struct TouchingSlots {
    Slots may[PlacedTriangles::most];
    Slots certain[PlacedTriangles::most];
};

/// Adds the triangles of a from slot `first` on, which are placed. Returns a bit for each of b that may touch some.
template <class Slots>
ESPALIER_NOINLINE unsigned match_touching(const PlacedTriangles& of_a, unsigned used, unsigned first,
                                          const PlacedTriangles& of_b, unsigned near, TouchingSlots<Slots>& slots) {
    MeetingBoxes meeting(near);
    meeting.find(of_a, used, of_b);
    unsigned touching = 0;
    PairsInLanes pairs;
    const auto match = [&] {
        unsigned certain = 0;
        for (unsigned rest = match_pairs(of_a, of_b, pairs, certain); rest != 0; rest &= rest - 1) {
            const auto lane = static_cast<unsigned>(std::countr_zero(rest));
            const unsigned place = pairs.b[lane], slot = first + pairs.a[lane];
            slots.may[place] |= Slots{1} << slot;
            slots.certain[place] |= Slots{certain >> lane & 1u} << slot;
            touching |= 1u << place;
        }
        pairs.count = 0;
    };
    for (unsigned first_of_word = 0; first_of_word < meeting.count; first_of_word += MeetingBoxes::in_word)
        for (std::uint64_t rest = meeting.words[first_of_word / MeetingBoxes::in_word]; rest != 0; rest &= rest - 1) {
            const auto bit = static_cast<unsigned>(std::countr_zero(rest));
            pairs.a[pairs.count] = static_cast<std::uint8_t>(bit % MeetingBoxes::bits);
            pairs.b[pairs.count] = meeting.place[first_of_word + bit / MeetingBoxes::bits];
            if (++pairs.count == PairsInLanes::most) match();
        }
    if (pairs.count != 0) match();
    return touching;
}

template <class Leaves>
ESPALIER_NOINLINE bool touch_exactly(const Leaves& leaves, unsigned a_slot, unsigned b_slot) {
    return triangles_meet(leaves.triangle_a(a_slot), leaves.triangle_b(b_slot));
}

/// The leaves that a walk has placed last. One of the two often stays while the other changes.
struct PlacedLeaves {
    PlacedTriangles a, b;
};

/// Calls visit with the storage indices of each pair of triangles of the leaves that touches: b's in storage order, for
/// each of them a's.
template <class Leaves>
ESPALIER_NOINLINE Visit visit_touching(const Leaves& leaves, PlacedLeaves& placed, OnTouching visit) {
    using Slots = typename Leaves::A::Slots;
    const auto& a = leaves.a;
    const auto& b = leaves.b;
    auto b_corners = corners_of(b);
    for (unsigned b_first = 0; b_first < b.slot_count;) {
        const unsigned near = place_near(b, leaves.b_place, leaves.frame, leaves.box, b_corners, b_first, placed.b);
        if (near == 0) continue;
        TouchingSlots<Slots> slots = {};
        unsigned touching = 0;
        auto a_corners = corners_of(a);
        for (unsigned a_first = 0; a_first < a.slot_count; a_first += PlacedTriangles::most) {
            place_in_lanes(a, leaves.a_place, leaves.frame, a_corners, a_first, placed.a);
            const auto used = static_cast<unsigned>(a.used_slots() >> a_first) & ((1u << PlacedTriangles::most) - 1u);
            touching |= match_touching(placed.a, used, a_first, placed.b, near, slots);
        }
        for (; touching != 0; touching &= touching - 1) {
            const auto place = static_cast<unsigned>(std::countr_zero(touching));
            const unsigned b_slot = placed.b.slot[place];
            for (auto may = slots.may[place]; may != 0; may &= may - 1) {
                const auto slot = static_cast<unsigned>(std::countr_zero(may));
                if ((slots.certain[place] >> slot & 1u) == 0 && !touch_exactly(leaves, slot, b_slot)) continue;
                const auto place_both = [&](LatticeTriangle& of_a, LatticeTriangle& of_b) {
                    of_a = leaves.triangle_a(slot);
                    of_b = leaves.triangle_b(b_slot);
                };
                if (visit(leaves.at(slot, b_slot), place_both) == Visit::stop) return Visit::stop;
            }
        }
    }
    return Visit::next;
}

ESPALIER_END_SET

#endif
