// Which triangles of two leaves are within a distance of each other, in lanes: these only reject. Included once per
// instruction set, inside its namespace.

/// Coordinates are below 2^24, and three products with a direction of length 1 are off by less than this.
inline constexpr float along_slack = 32.0f;

/// What triangles cover along a direction.
struct Shadow {
    Floats low, high;
    [[gnu::always_inline]] Shadow(const PlacedLanes& t, const float* axis) {
        const auto along = [&](const Floats* corner) {
            return add(add(multiply(corner[0], splat(axis[0])), multiply(corner[1], splat(axis[1]))),
                       multiply(corner[2], splat(axis[2])));
        };
        const Floats a = along(t.corner[0]), b = along(t.corner[1]), c = along(t.corner[2]);
        low = smaller(a, smaller(b, c));
        high = larger(a, larger(b, c));
    }
};

/// Three corners' distances from a plane, times its normal's length: how far the nearest is, if all are on one side;
/// else below zero.
inline Floats separation(Floats x, Floats y, Floats z) {
    return larger(smaller(x, smaller(y, z)), negate(larger(x, larger(y, z))));
}

/// How far two squared lengths may differ for their roundings: those of boxes and planes are less.
inline constexpr float lower_slack = 1.0f + 0x1p-18f;

/// The pair with the nearest corners, of equal ones the first of b, then of a: a good one to begin with, and in
/// the first look, which takes all columns together, the same one whatever the number of lanes.
struct NearestCorners {
    static constexpr unsigned a_slots = 64;
    static_assert(StripLeaf::max_slots <= a_slots && PlainLeaf::max_slots <= a_slots);

    float squared = infinity;
    unsigned pair = 0;          ///< b's slot times a_slots, and a's
    unsigned first_column = 0;  ///< whose slot in b is the first of those that are offered

    [[nodiscard]] unsigned a_slot() const { return pair % a_slots; }
    [[nodiscard]] unsigned b_slot() const { return pair / a_slots; }
    void offer(float other_squared, unsigned other) {
        if (other_squared > squared || (other_squared == squared && other > pair)) return;
        squared = other_squared;
        pair = other;
    }
};

/// How far apart triangles are along the directions, squared.
[[gnu::always_inline]] inline Floats gap_along_axes(const PlacedLanes& t, const PlacedLanes& other,
                                                    const PairAxes& axes) {
    Floats along_sum = splat(0.0f);
    for (int i = 0; i < 3; ++i) {
        const Shadow ours(t, axes.at[i]), theirs(other, axes.at[i]);
        const Floats apart = larger(subtract(theirs.low, ours.high), subtract(ours.low, theirs.high));
        const Floats gap = larger(subtract(apart, splat(2.0f * along_slack)), splat(0.0f));
        along_sum = add(along_sum, multiply(gap, gap));
    }
    return along_sum;
}

/// Of their corners, the nearest two.
[[gnu::always_inline]] inline Floats squared_of_nearest_corners(const PlacedLanes& t, const PlacedLanes& other) {
    Floats nearest = splat(infinity);
    for (const auto& ours : t.corner)
        for (const auto& their : other.corner) {
            Floats squared = splat(0.0f);
            for (int k = 0; k < 3; ++k) {
                const Floats apart = subtract(ours[k], their[k]);
                squared = add(multiply(apart, apart), squared);
            }
            nearest = smaller(squared, nearest);
        }
    return nearest;
}

/// Which of the triangles may be within the squared distance of the column's. The corners also tell how far apart these
/// are at most, and the limit comes down to that.
[[gnu::noinline]] inline unsigned match_near(const PlacedLanes& t, const PlacedColumns& others, unsigned column,
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
    const auto is_near = [&](Floats apart, const Floats* normal, Floats size) {
        const Floats far_off = larger(subtract(apart, multiply(multiply(size, size), small)), splat(0.0f));
        const Floats length =
            add(add(multiply(normal[0], normal[0]), multiply(normal[1], normal[1])), multiply(normal[2], normal[2]));
        return at_most(multiply(far_off, far_off), multiply(bound, length));
    };
    near &= is_near(separation(distance_along(other.corner[0], t.corner[0], other.normal),
                               distance_along(other.corner[0], t.corner[1], other.normal),
                               distance_along(other.corner[0], t.corner[2], other.normal)),
                    other.normal, other.size);
    if (near == 0) return 0;
    return near & is_near(separation(distance_along(t.corner[0], other.corner[0], t.normal),
                                     distance_along(t.corner[0], other.corner[1], t.normal),
                                     distance_along(t.corner[0], other.corner[2], t.normal)),
                          t.normal, t.size);
}

/// The triangles of a leaf of a that may be within the squared distance of each of the columns.
template <class Leaf>
[[gnu::noinline]] void match_near(const Leaf& leaf, const PairFrame& frame, const PlacedColumns& others, unsigned near,
                                  const PairAxes& axes, float& limit, NearestCorners& nearest,
                                  typename Leaf::Slots* slots) {
    for (unsigned rest = near; rest != 0; rest &= rest - 1) slots[std::countr_zero(rest)] = 0;
    auto corners = corners_of(leaf);
    for (unsigned first = 0; first < leaf.slot_count; first += lanes) {
        PlacedLanes t;
        load_lanes(leaf, frame, corners, t);
        const auto used = static_cast<unsigned>(leaf.used_slots() >> first) & ((1u << lanes) - 1u);
        for (unsigned rest = near; rest != 0; rest &= rest - 1) {
            const auto column = static_cast<unsigned>(std::countr_zero(rest));
            const unsigned first_pair = (nearest.first_column + column) * NearestCorners::a_slots + first;
            slots[column] |= typename Leaf::Slots{match_near(t, others, column, used, axes, limit, nearest, first_pair)}
                             << first;
        }
    }
}

template <class LeafA, class LeafB, class Visitor>
[[gnu::noinline]] Visit visit_exactly(const PairFrame& frame, const LeafA& a, unsigned a_slot, const LeafB& b,
                                      unsigned b_slot, Visitor& visitor) {
    const auto pair = [&] { return TrianglePair{{owner_index(a, a_slot)}, {owner_index(b, b_slot)}}; };
    return visitor.visit_pair(frame.place_a(a.triangle(a_slot)), frame.place_b(b.triangle(b_slot)), pair);
}

/// Calls visit_pair for the triangles of two leaves that may be within the visitor's limit of each other.
template <class LeafA, class LeafB, class Visitor>
[[gnu::noinline]] Visit visit_near(const PairFrame& frame, PairLeaf a_place, PairLeaf b_place, const TwiceBox& a_box,
                                   Visitor& visitor) {
    const auto a = leaf_of_pair<LeafA>(frame, 0, a_place);
    const auto b = leaf_of_pair<LeafB>(frame, 1, b_place);
    const PlacedBox box(a_box, frame);
    auto corners = corners_of(b);
    const auto visit = [&](unsigned a_slot, unsigned b_slot) {
        return visit_exactly(frame, a, a_slot, b, b_slot, visitor);
    };
    NearestCorners nearest;
    for (unsigned first = 0; first < b.slot_count; first += columns) {
        PlacedColumns others;
        const float limit_before = visitor.limit();
        unsigned near = place_columns<false>(b, frame, first, corners, box, limit_before, others);
        if (near == 0) continue;
        typename LeafA::Slots slots[columns];
        const auto match_all = [&] {
            float limit = visitor.limit();
            match_near(a, frame, others, near, visitor.axes(0), limit, nearest, slots);
            visitor.lower_limit(limit);
        };
        nearest.first_column = first;
        match_all();
        if (visitor.surveys) continue;
        // The most promising pair first: what it finds rules most of the others out.
        if (const unsigned column = nearest.b_slot() - first; nearest.squared < infinity && column < columns) {
            const auto bit = typename LeafA::Slots{1} << nearest.a_slot();
            if ((slots[column] & bit) != 0) {
                if (visit(nearest.a_slot(), nearest.b_slot()) == stop) return stop;
                if (visitor.limit() < limit_before) match_all();
                slots[column] &= ~bit;
            }
        }
        for (; near != 0; near &= near - 1) {
            const auto column = static_cast<unsigned>(std::countr_zero(near));
            for (auto mask = slots[column]; mask != 0; mask &= mask - 1)
                if (visit(static_cast<unsigned>(std::countr_zero(mask)), first + column) == stop) return stop;
        }
    }
    return visitor.surveys && nearest.squared < infinity ? visit(nearest.a_slot(), nearest.b_slot()) : keep_going;
}
