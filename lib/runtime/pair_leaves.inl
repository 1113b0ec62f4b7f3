// A leaf of each tree: the triangles of the one in lanes against triangles of the other, some at a time. Included once
// per instruction set, inside its namespace. Lanes only ever reject.

/// Triangles of b on the common grid.
struct PlacedTriangle {
    float corner[3][3];  ///< integers
    float low[3];
    float high[3];
    float normal[3];
    float
        slack;  ///< more than what rounding does to the distance of a near triangle's corners from the plane, and back
    float slack_for_reach;
    float along_low[3];  ///< along perpendicular directions
    float along_high[3];
    unsigned slot;
};

[[gnu::noinline]] inline void load_placed(const LatticeTriangle& exact, unsigned slot, float other_size,
                                          PlacedTriangle& t) {
    t.slot = slot;
    float size = 0.0f;
    for (int k = 0; k < 3; ++k) {
        for (int corner = 0; corner < 3; ++corner) t.corner[corner][k] = static_cast<float>(exact.corner[corner][k]);
        t.low[k] = minimum(t.corner[0][k], minimum(t.corner[1][k], t.corner[2][k]));
        t.high[k] = maximum(t.corner[0][k], maximum(t.corner[1][k], t.corner[2][k]));
        size = maximum(t.high[k] - t.low[k], size);
    }
    float ab[3], ac[3];
    for (int k = 0; k < 3; ++k) {
        ab[k] = t.corner[1][k] - t.corner[0][k];
        ac[k] = t.corner[2][k] - t.corner[0][k];
    }
    for (int k = 0; k < 3; ++k) {
        const int k1 = k == 2 ? 0 : k + 1, k2 = k == 0 ? 2 : k - 1;
        t.normal[k] = ab[k1] * ac[k2] - ab[k2] * ac[k1];
    }
    const float largest = maximum(size, other_size);
    t.slack_for_reach = 0x1p-17f * (largest * largest);
    t.slack = t.slack_for_reach * (size + other_size);
}

/// Coordinates are below 2^24, and three products with a direction of length 1 are off by less than this.
inline constexpr float along_slack = 32.0f;

inline LatticeTriangle exactly(const PlacedTriangle& t) {
    LatticeTriangle exact;
    for (int corner = 0; corner < 3; ++corner)
        for (int k = 0; k < 3; ++k) exact.corner[corner][k] = static_cast<std::int32_t>(t.corner[corner][k]);
    return exact;
}

inline void set_reach_along(const PairAxes& axes, PlacedTriangle& t) {
    for (int i = 0; i < 3; ++i) {
        const float* axis = axes.at[i];
        const auto along = [&](const float* corner) {
            return corner[0] * axis[0] + corner[1] * axis[1] + corner[2] * axis[2];
        };
        const float a = along(t.corner[0]), b = along(t.corner[1]), c = along(t.corner[2]);
        t.along_low[i] = minimum(a, minimum(b, c)) - along_slack;
        t.along_high[i] = maximum(a, maximum(b, c)) + along_slack;
    }
}

/// Triangles of a leaf of a, `lanes` of them, on the common grid.
struct PlacedLanes {
    Floats corner[3][3];
    Floats low[3];
    Floats high[3];
    Floats normal[3];
};

/// (to - from) . direction, for as many as there are lanes.
inline Floats distance_along(const Floats* from, const Floats* to, const Floats* direction) {
    return add(add(multiply(subtract(to[0], from[0]), direction[0]), multiply(subtract(to[1], from[1]), direction[1])),
               multiply(subtract(to[2], from[2]), direction[2]));
}

/// Three corners' distances from a plane, times its normal's length: how far the nearest is, if all are on one side;
/// else below zero.
inline Floats separation(Floats x, Floats y, Floats z) {
    return larger(smaller(x, smaller(y, z)), negate(larger(x, larger(y, z))));
}

/// How far two squared lengths may differ for their roundings: those of boxes and planes are less.
inline constexpr float lower_slack = 1.0f + 0x1p-18f;

/// The pair with the nearest corners: a good one to begin with.
struct NearestCorners {
    float squared = infinity;
    unsigned slot = 0;
    unsigned other = 0;
};

/// Which of the triangles may touch the other one, or may be within the squared distance of it. For distances the
/// corners also tell how far apart these triangles are at most, and the limit comes down to that.
template <bool touching>
[[gnu::noinline]] unsigned match(const PlacedLanes& t, const PlacedTriangle& other, unsigned used,
                                 [[maybe_unused]] const PairAxes& axes, float& limit,
                                 [[maybe_unused]] NearestCorners& nearest_corners, unsigned first, unsigned number) {
    Floats sum = splat(0.0f);
    for (int k = 0; k < 3; ++k) {
        const Floats gap = larger(
            larger(subtract(t.low[k], splat(other.high[k])), subtract(splat(other.low[k]), t.high[k])), splat(0.0f));
        sum = add(sum, multiply(gap, gap));
    }
    unsigned near = at_most(sum, splat(limit)) & used;
    if (near == 0) return 0;
    if constexpr (!touching) {
        Floats along_sum = splat(0.0f);
        for (int i = 0; i < 3; ++i) {
            const auto along = [&](const Floats* corner) {
                return add(add(multiply(corner[0], splat(axes.at[i][0])), multiply(corner[1], splat(axes.at[i][1]))),
                           multiply(corner[2], splat(axes.at[i][2])));
            };
            const Floats a = along(t.corner[0]), b = along(t.corner[1]), c = along(t.corner[2]);
            const Floats gap = larger(larger(subtract(splat(other.along_low[i]), larger(a, larger(b, c))),
                                             subtract(smaller(a, smaller(b, c)), splat(other.along_high[i]))),
                                      splat(0.0f));
            along_sum = add(along_sum, multiply(gap, gap));
        }
        near &= at_most(along_sum, splat(limit));
        if (near == 0) return 0;
    }
    Floats theirs[3][3];
    for (int corner = 0; corner < 3; ++corner)
        for (int k = 0; k < 3; ++k) theirs[corner][k] = splat(other.corner[corner][k]);
    const Floats their_normal[3] = {splat(other.normal[0]), splat(other.normal[1]), splat(other.normal[2])};
    const Floats from_theirs = separation(distance_along(theirs[0], t.corner[0], their_normal),
                                          distance_along(theirs[0], t.corner[1], their_normal),
                                          distance_along(theirs[0], t.corner[2], their_normal));
    const auto from_ours = [&] {
        return separation(distance_along(t.corner[0], theirs[0], t.normal),
                          distance_along(t.corner[0], theirs[1], t.normal),
                          distance_along(t.corner[0], theirs[2], t.normal));
    };
    if constexpr (touching) {
        near &= at_most(from_theirs, splat(other.slack));
        return near == 0 ? 0 : near & at_most(from_ours(), splat(other.slack));
    } else {
        Floats nearest = splat(infinity);
        for (const auto& ours : t.corner)
            for (const auto& their : theirs) {
                Floats squared = splat(0.0f);
                for (int k = 0; k < 3; ++k) {
                    const Floats apart = subtract(ours[k], their[k]);
                    squared = add(multiply(apart, apart), squared);
                }
                nearest = smaller(squared, nearest);
            }
        float at_most_apart[lanes];
        store(at_most_apart, nearest);
        for (unsigned rest = near; rest != 0; rest &= rest - 1) {
            const auto lane = static_cast<unsigned>(std::countr_zero(rest));
            if (at_most_apart[lane] < nearest_corners.squared)
                nearest_corners = {at_most_apart[lane], first + lane, number};
        }
        limit = minimum(nearest_corners.squared * lower_slack, limit);
        const Floats bound = splat(limit * lower_slack);
        // From boxes within the limit of each other: distances along an axis are longer by its root.
        const Floats slack = splat(other.slack + other.slack_for_reach * square_root(limit));
        const auto is_near = [&](Floats apart, const Floats* normal) {
            const Floats least = larger(subtract(apart, slack), splat(0.0f));
            const Floats length = add(add(multiply(normal[0], normal[0]), multiply(normal[1], normal[1])),
                                      multiply(normal[2], normal[2]));
            return at_most(multiply(least, least), multiply(bound, length));
        };
        near &= is_near(from_theirs, their_normal);
        return near == 0 ? 0 : near & is_near(from_ours(), t.normal);
    }
}

/// The triangles of a leaf of a that may touch each of the given ones, or be within the squared distance of them.
template <bool touching, unsigned groups, class Leaf>
inline void match_triangles_of(const Leaf& leaf, const PairFrame& frame, const PlacedTriangle* others, unsigned count,
                               const PairAxes& axes, float& limit, NearestCorners& nearest,
                               typename Leaf::Slots* masks) {
    Table<groups> coordinates[3];
    for (unsigned k = 0; k < 3; ++k) {
        const Floats anchor = splat(static_cast<float>(leaf.anchor(static_cast<int>(k))));
        const Floats scale = splat(frame.a_scale);
        const Floats round = splat(frame.a_round);
        for (unsigned group = 0; group < Table<groups>::groups_of(leaf.vertex_count); ++group) {
            const Floats offset = to_floats(unpack(leaf.coordinates[k], leaf.width[k], group * lanes));
            coordinates[k].set(group, subtract(add(multiply(add(offset, anchor), scale), round), round));
        }
    }
    for (unsigned i = 0; i < count; ++i) masks[i] = 0;
    auto corners = corners_of(leaf);
    for (unsigned first = 0; first < leaf.slot_count; first += lanes) {
        PlacedLanes t;
        look_up_corners(coordinates, corners.next(), t.corner);
        for (int k = 0; k < 3; ++k) {
            t.low[k] = smaller(t.corner[0][k], smaller(t.corner[1][k], t.corner[2][k]));
            t.high[k] = larger(t.corner[0][k], larger(t.corner[1][k], t.corner[2][k]));
        }
        for (int k = 0; k < 3; ++k) {
            const int k1 = k == 2 ? 0 : k + 1, k2 = k == 0 ? 2 : k - 1;
            t.normal[k] = subtract(
                multiply(subtract(t.corner[1][k1], t.corner[0][k1]), subtract(t.corner[2][k2], t.corner[0][k2])),
                multiply(subtract(t.corner[1][k2], t.corner[0][k2]), subtract(t.corner[2][k1], t.corner[0][k1])));
        }
        const auto used = static_cast<unsigned>(leaf.used_slots() >> first) & ((1u << lanes) - 1u);
        for (unsigned i = 0; i < count; ++i)
            masks[i] |= typename Leaf::Slots{match<touching>(t, others[i], used, axes, limit, nearest, first, i)}
                        << first;
    }
}

template <bool touching, class Leaf>
[[gnu::noinline]] void match_triangles(const Leaf& leaf, const PairFrame& frame, const PlacedTriangle* others,
                                       unsigned count, const PairAxes& axes, float& limit, NearestCorners& nearest,
                                       typename Leaf::Slots* masks) {
    with_table_groups<Leaf::max_vertices>(leaf.vertex_count, [&](auto groups) {
        match_triangles_of<touching, groups>(leaf, frame, others, count, axes, limit, nearest, masks);
        return 0;
    });
}
