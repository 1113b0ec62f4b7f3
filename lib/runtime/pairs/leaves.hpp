// A leaf of each tree on the common grid: some triangles of b as columns, those of a in lanes.
#ifndef ESPALIER_PAIRS_LEAVES_HPP
#define ESPALIER_PAIRS_LEAVES_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/pairs/trees.hpp>

ESPALIER_BEGIN_SET

/// How many triangles of b go against a leaf of a at a time.
inline constexpr unsigned columns = lanes > 4 ? lanes : 4;

/// Triangles of b, a column each.
struct PlacedColumns {
    Floats corner[columns / lanes][3][3];

    [[nodiscard]] float at(unsigned column, int number, int axis) const {
        float coordinate;
        const auto* lane = reinterpret_cast<const std::byte*>(&corner[column / lanes][number][axis]);
        ESPALIER_COPY_BYTES(&coordinate, lane + sizeof coordinate * (column % lanes), sizeof coordinate);
        return coordinate;
    }
};

inline Floats least(Floats x, Floats y, Floats z) { return smaller(x, smaller(y, z)); }
inline Floats most(Floats x, Floats y, Floats z) { return larger(x, larger(y, z)); }

/// Corner 0, 1, 2 of as many triangles as there are lanes, each x, y, z, and what follows from them. Coordinates and
/// what is subtracted from them are integers, and exact below 2^24.
struct PlacedLanes {
    Floats corner[3][3];
    Floats low[3];
    Floats high[3];
    Floats normal[3];
    Floats size;  ///< the longest side of the box

    ESPALIER_ALWAYS_INLINE void derive_box() {
        for (int k = 0; k < 3; ++k) {
            low[k] = least(corner[0][k], corner[1][k], corner[2][k]);
            high[k] = most(corner[0][k], corner[1][k], corner[2][k]);
        }
    }
    ESPALIER_ALWAYS_INLINE void derive_plane() {
        size = most(subtract(high[0], low[0]), subtract(high[1], low[1]), subtract(high[2], low[2]));
        Floats ab[3], ac[3];
        for (int k = 0; k < 3; ++k) {
            ab[k] = subtract(corner[1][k], corner[0][k]);
            ac[k] = subtract(corner[2][k], corner[0][k]);
        }
        cross(ab, ac, normal);
    }
    /// Copies one triangle to all lanes.
    template <class Triangles>
    ESPALIER_ALWAYS_INLINE void spread(const Triangles& triangles, unsigned place) {
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) corner[i][k] = splat(triangles.at(place, i, k));
    }
    ESPALIER_ALWAYS_INLINE static void cross(const Floats* p, const Floats* q, Floats* to) {
        for (int k = 0; k < 3; ++k) {
            const int k1 = k == 2 ? 0 : k + 1, k2 = k == 0 ? 2 : k - 1;
            to[k] = subtract(multiply(p[k1], q[k2]), multiply(p[k2], q[k1]));
        }
    }
};

/// A box of a's tree on the grid, with room for the rounding of what is in it.
struct PlacedBox {
    float low[3];
    float high[3];
    float size = 0.0f;

    PlacedBox(const TwiceBox& box, const PairFrame& frame) {
        constexpr float rounding = 2.0f;
        for (int k = 0; k < 3; ++k) {
            low[k] = (box.center[k] - box.half[k]) * (0.5f * frame.a_scale) - rounding;
            high[k] = (box.center[k] + box.half[k]) * (0.5f * frame.a_scale) + rounding;
            size = maximum(high[k] - low[k], size);
        }
    }
};

/// How far boxes are apart, squared.
ESPALIER_ALWAYS_INLINE inline Floats squared_gap(const PlacedLanes& t, const Floats* low, const Floats* high) {
    Floats sum = splat(0.0f);
    for (unsigned k = 0; k < 3; ++k) {
        const Floats gap = larger(larger(subtract(t.low[k], high[k]), subtract(low[k], t.high[k])), splat(0.0f));
        sum = add(sum, multiply(gap, gap));
    }
    return sum;
}

/// (to - from) . direction, for as many as there are lanes.
inline Floats distance_along(const Floats* from, const Floats* to, const Floats* direction) {
    return add(add(multiply(subtract(to[0], from[0]), direction[0]), multiply(subtract(to[1], from[1]), direction[1])),
               multiply(subtract(to[2], from[2]), direction[2]));
}

/// Computes how far the corners of t are from the plane of the other triangle, times the length of its normal.
inline void distances_from_plane(const PlacedLanes& t, const PlacedLanes& plane, Floats* distances) {
    for (int i = 0; i < 3; ++i) distances[i] = distance_along(plane.corner[0], t.corner[i], plane.normal);
}
/// How far the nearest of three corners is from a plane, by their distances, if all are on one side; else below zero.
inline Floats separation(const Floats* distances) {
    return larger(least(distances[0], distances[1], distances[2]),
                  negate(most(distances[0], distances[1], distances[2])));
}

/// More than what rounding does to a product of three lengths that sums of differences of such sizes make: see "Two
/// blobs on one grid" in docs/numerics.md.
inline constexpr float volume_slack = 0x1p-17f;

/// Whether the planes of the triangles pass by the box, in lanes where triangles and box meet.
inline unsigned planes_meet(const PlacedLanes& t, const PlacedBox& box) {
    Floats along = splat(0.0f), reach = splat(0.0f);
    for (int k = 0; k < 3; ++k) {
        along = add(along, multiply(subtract(splat(0.5f * (box.low[k] + box.high[k])), t.corner[0][k]), t.normal[k]));
        reach = add(reach, multiply(splat(0.5f * (box.high[k] - box.low[k])), magnitude(t.normal[k])));
    }
    const Floats slack =
        multiply(multiply(t.size, t.size), multiply(add(t.size, splat(box.size)), splat(volume_slack)));
    return at_most(subtract(magnitude(along), reach), slack);
}

/// Coordinates by vertex, for leaves of every kind and size.
inline constexpr unsigned most_vertices =
    StripLeaf::max_vertices > PlainLeaf::max_vertices ? StripLeaf::max_vertices : PlainLeaf::max_vertices;
using VertexTable =
    Table<with_table_groups<most_vertices>(most_vertices, [](auto groups) { return unsigned{groups}; })>;

/// One coordinate of the corners.
template <unsigned used>
inline void look_up_among(const VertexTable& coordinates, const CornerNumbers& numbers, Floats (*corner)[3], int axis) {
    corner[0][axis] = coordinates.template look_up_among<used>(numbers.a);
    corner[1][axis] = coordinates.template look_up_among<used>(numbers.b);
    corner[2][axis] = coordinates.template look_up_among<used>(numbers.c);
}

/// All of them: a function for each size of leaf, so that their frames do not add up.
template <unsigned used>
ESPALIER_NOINLINE void look_up_all(const VertexTable* coordinates, const CornerNumbers& numbers, Floats (*corner)[3]) {
    for (int k = 0; k < 3; ++k) look_up_among<used>(coordinates[k], numbers, corner, k);
}

/// One coordinate of all vertices of a leaf of a.
template <class Leaf>
ESPALIER_ALWAYS_INLINE inline void place_axis_of_a(const Leaf& leaf, const PairFrame& frame, int axis,
                                                   VertexTable& coordinates) {
    const Floats scale = splat(frame.a_scale), round = splat(frame.a_round);
    const auto anchor = static_cast<std::uint32_t>(leaf.anchor(axis));
    unsigned group = 0;
    do {
        const Floats coordinate = to_floats(add(offsets_of(leaf, static_cast<unsigned>(axis), group), anchor));
        coordinates.set(group, subtract(add(multiply(coordinate, scale), round), round));
    } while (++group * lanes < leaf.vertex_count);
}

/// The next triangles of a leaf of a. One axis at a time: a table of all three would be most of the stack.
template <class Leaf, class Corners>
ESPALIER_NOINLINE void load_lanes(const Leaf& leaf, const PairFrame& frame, Corners& corners, PlacedLanes& t) {
    const CornerNumbers numbers = corners.next();
    with_table_groups<Leaf::max_vertices>(leaf.vertex_count, [&](auto used) {
        for (int k = 0; k < 3; ++k) {
            VertexTable coordinates;
            place_axis_of_a(leaf, frame, k, coordinates);
            look_up_among<used>(coordinates, numbers, t.corner, k);
        }
        return 0;
    });
    t.derive_box();
    t.derive_plane();
}

/// Returns a bit for each lane whose box is near enough; if `touching`, its plane must also pass through the box.
ESPALIER_ALWAYS_INLINE inline unsigned lanes_near(PlacedLanes t, const PlacedBox& box, bool touching, float limit) {
    t.derive_box();
    Floats low[3], high[3];
    for (int k = 0; k < 3; ++k) {
        low[k] = splat(box.low[k]);
        high[k] = splat(box.high[k]);
    }
    unsigned near = at_most(squared_gap(t, low, high), splat(limit));
    if (touching) {
        t.derive_plane();
        near &= planes_meet(t, box);
    }
    return near;
}

ESPALIER_NOINLINE inline unsigned lanes_near(const Floats (*corner)[3], const PlacedBox& box, bool touching,
                                             float limit) {
    PlacedLanes t;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) t.corner[i][k] = corner[i][k];
    return lanes_near(t, box, touching, limit);
}

template <class Leaf>
ESPALIER_NOINLINE void place_vertices(const Leaf& leaf, const PairFrame& frame, VertexTable* coordinates) {
    for (unsigned group = 0; group * lanes < leaf.vertex_count; ++group) {
        Ints vertex[3];
        for (int k = 0; k < 3; ++k)
            vertex[k] =
                add(offsets_of(leaf, static_cast<unsigned>(k), group), static_cast<std::uint32_t>(leaf.anchor(k)));
        for (int k = 0; k < 3; ++k)
            coordinates[k].set(group,
                               place_on_axis(frame.matrix[k], frame.translation[k], frame.fraction_bits, vertex));
    }
}

/// The next triangles of a leaf of b as columns.
template <class Leaf, class Corners>
ESPALIER_NOINLINE void load_columns(const Leaf& leaf, const PairFrame& frame, unsigned first, Corners& corners,
                                    PlacedColumns& placed) {
    VertexTable coordinates[3];
    place_vertices(leaf, frame, coordinates);
    for (unsigned column = 0; column < columns && first + column < leaf.slot_count; column += lanes) {
        const CornerNumbers numbers = corners.next();
        with_table_groups<Leaf::max_vertices>(leaf.vertex_count, [&](auto used) {
            look_up_all<used>(coordinates, numbers, placed.corner[column / lanes]);
            return 0;
        });
    }
}

/// The next triangles of a leaf of b as columns; a bit for each that is near enough to the box.
template <class Leaf, class Corners>
inline unsigned place_columns(const Leaf& leaf, const PairFrame& frame, unsigned first, Corners& corners,
                              const PlacedBox& box, bool touching, float limit, PlacedColumns& placed) {
    load_columns(leaf, frame, first, corners, placed);
    unsigned near = 0;
    for (unsigned column = 0; column < columns && first + column < leaf.slot_count; column += lanes)
        near |= lanes_near(placed.corner[column / lanes], box, touching, limit) << column;
    return near & static_cast<unsigned>(leaf.used_slots() >> first) & ((1u << columns) - 1u);
}

/// Calls match(lanes of a, slot of the first, column of b, which lanes are used) for all triangles of a leaf of a and
/// the columns.
template <class Leaf, class Match>
ESPALIER_ALWAYS_INLINE inline void for_lanes_and_columns(const Leaf& leaf, const PairFrame& frame, unsigned near,
                                                         Match match) {
    auto corners = corners_of(leaf);
    for (unsigned first = 0; first < leaf.slot_count; first += lanes) {
        PlacedLanes t;
        load_lanes(leaf, frame, corners, t);
        const auto used = static_cast<unsigned>(leaf.used_slots() >> first) & ((1u << lanes) - 1u);
        for (unsigned rest = near; rest != 0; rest &= rest - 1)
            match(t, first, static_cast<unsigned>(std::countr_zero(rest)), used);
    }
}

#if !ESPALIER_SMALL_CODE
/// The last leaf of a tree that was decoded: it stays while that of the other tree changes.
class DecodedLeaf {
public:
    DecodedLeaf() {}
    template <class Leaf>
    ESPALIER_ALWAYS_INLINE const Leaf& decode(const PairFrame& frame, unsigned side, PairLeaf place) {
        Leaf& leaf = of<Leaf>();
        if (place_ != place) decode_leaf_of_pair(frame, side, place, leaf);
        place_ = place;
        return leaf;
    }

private:
    template <class Leaf>
    Leaf& of() {
        if constexpr (std::is_same_v<Leaf, PlainLeaf>) return plain_;
        else return strip_;
    }

    union {
        PlainLeaf plain_;
        StripLeaf strip_;
    };
    PairLeaf place_ = no_leaf;
};
#endif

/// A leaf of each, and the box of a's.
template <class LeafA, class LeafB>
struct LeafPair {
    using A = LeafA;
    using B = LeafB;
    const PairFrame& frame;
#if ESPALIER_SMALL_CODE
    A a;
    B b;
    PlacedBox box;

    LeafPair(const PairFrame& on_grid, PairLeaf a_place, PairLeaf b_place, const TwiceBox& a_box)
        : frame(on_grid), box(a_box, frame) {
        decode_leaf_of_pair(frame, 0, a_place, a);
        decode_leaf_of_pair(frame, 1, b_place, b);
    }
#else
    const A& a;
    const B& b;
    PlacedBox box;
    PairLeaf a_place, b_place;

    LeafPair(const PairFrame& on_grid, DecodedLeaf* decoded, PairLeaf of_a, PairLeaf of_b, const TwiceBox& a_box)
        : frame(on_grid),
          a(decoded[0].decode<A>(frame, 0, of_a)),
          b(decoded[1].decode<B>(frame, 1, of_b)),
          box(a_box, frame),
          a_place(of_a),
          b_place(of_b) {}
#endif
    [[nodiscard]] LatticeTriangle triangle_a(unsigned slot) const { return frame.place_a(a.triangle(slot)); }
    [[nodiscard]] LatticeTriangle triangle_b(unsigned slot) const { return frame.place_b(b.triangle(slot)); }
    [[nodiscard]] TrianglePair at(unsigned a_slot, unsigned b_slot) const {
        return {{storage_index(a, a_slot)}, {storage_index(b, b_slot)}};
    }
};

ESPALIER_END_SET

#endif
