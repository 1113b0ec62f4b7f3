// Triangles of a leaf that stay placed on the common grid: while the other leaf changes, and in memory, so that lanes
// can take any of them together.
#ifndef ESPALIER_PAIRS_PLACED_HPP
#define ESPALIER_PAIRS_PLACED_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/pairs/leaves.hpp>

ESPALIER_BEGIN_SET

/// Triangles of a leaf by their place: as many as a leaf of profile fast has, or some of a strip.
struct PlacedTriangles {
    static constexpr unsigned most = 16, groups = most / lanes;
    static_assert(!reads_plain_leaves || PlainLeaf::max_slots <= most);

    Table<groups> corner[3][3];  ///< corner 0, 1, 2, each x, y, z
    std::uint8_t slot[most];     ///< of the triangle in each place
    PairLeaf whole = no_leaf;    ///< the leaf whose triangles are all here, each in the place of its slot

    [[nodiscard]] const std::byte* row(int number, int axis) const {
        return reinterpret_cast<const std::byte*>(&corner[number][axis]);
    }
    [[nodiscard]] float at(unsigned place, int number, int axis) const {
        return load_as<float>(row(number, axis) + sizeof(float) * place);
    }
    void set(unsigned place, int number, int axis, float coordinate) {
        auto* const to = reinterpret_cast<std::byte*>(&corner[number][axis]);
        ESPALIER_COPY_BYTES(to + sizeof coordinate * place, &coordinate, sizeof coordinate);
    }
    /// `lanes` triangles, in order.
    [[nodiscard]] ESPALIER_ALWAYS_INLINE PlacedLanes group(unsigned number) const {
        PlacedLanes t;
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) t.corner[i][k] = load_as<Floats>(row(i, k) + sizeof(Floats) * number);
        return t;
    }
    /// Any triangles, by their places.
    [[nodiscard]] ESPALIER_ALWAYS_INLINE PlacedLanes some(const Numbers& places) const {
        PlacedLanes t;
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) t.corner[i][k] = corner[i][k].look_up(places);
        return t;
    }
};

/// How many groups of lanes so many slots take.
constexpr unsigned groups_of_slots(unsigned slots) { return (slots + lanes - 1) / lanes; }

/// Places the next triangles of a leaf of a.
template <class Leaf, class Corners>
ESPALIER_NOINLINE void place_triangles_of_a(const Leaf& leaf, const PairFrame& frame, Corners& corners, unsigned first,
                                            PlacedTriangles& placed) {
    const unsigned left = groups_of_slots(leaf.slot_count - first);
    const unsigned groups = left < PlacedTriangles::groups ? left : PlacedTriangles::groups;
    CornerNumbers numbers[PlacedTriangles::groups];
    for (unsigned group = 0; group < groups; ++group) numbers[group] = corners.next();
    with_table_groups<Leaf::max_vertices>(leaf.vertex_count, [&](auto used) {
        for (int k = 0; k < 3; ++k) {
            VertexTable coordinates;
            place_axis_of_a(leaf, frame, k, coordinates);
            for (unsigned group = 0; group < groups; ++group) {
                placed.corner[0][k].set(group, coordinates.template look_up_among<used>(numbers[group].a));
                placed.corner[1][k].set(group, coordinates.template look_up_among<used>(numbers[group].b));
                placed.corner[2][k].set(group, coordinates.template look_up_among<used>(numbers[group].c));
            }
        }
        return 0;
    });
}

/// Has the next triangles of a leaf of a placed.
template <class Leaf, class Corners>
inline void place_in_lanes(const Leaf& leaf, PairLeaf place, const PairFrame& frame, Corners& corners, unsigned first,
                           PlacedTriangles& placed) {
    if (placed.whole == place) return;
    place_triangles_of_a(leaf, frame, corners, first, placed);
    placed.whole = leaf.slot_count <= PlacedTriangles::most ? place : no_leaf;
}

/// Places all triangles of a leaf of b, which has no more than there is room for.
template <class Leaf, class Corners>
ESPALIER_NOINLINE void place_triangles_of_b(const Leaf& leaf, const PairFrame& frame, Corners& corners,
                                            PlacedTriangles& placed) {
    VertexTable coordinates[3];
    place_vertices(leaf, frame, coordinates);
    for (unsigned group = 0; group < groups_of_slots(leaf.slot_count); ++group) {
        const CornerNumbers numbers = corners.next();
        with_table_groups<Leaf::max_vertices>(leaf.vertex_count, [&](auto used) {
            for (int k = 0; k < 3; ++k) {
                placed.corner[0][k].set(group, coordinates[k].template look_up_among<used>(numbers.a));
                placed.corner[1][k].set(group, coordinates[k].template look_up_among<used>(numbers.b));
                placed.corner[2][k].set(group, coordinates[k].template look_up_among<used>(numbers.c));
            }
            return 0;
        });
    }
    for (unsigned slot = 0; slot < PlacedTriangles::most; ++slot) placed.slot[slot] = static_cast<std::uint8_t>(slot);
}

/// Places the triangles of a leaf of b, from slot `first` on, that are near the box, while there is room. Returns how
/// many they are.
template <class Leaf, class Corners>
ESPALIER_NOINLINE unsigned place_some_of_b(const Leaf& leaf, const PairFrame& frame, const PlacedBox& box,
                                           Corners& corners, unsigned& first, PlacedTriangles& placed) {
    VertexTable coordinates[3];
    place_vertices(leaf, frame, coordinates);
    unsigned count = 0;
    do {
        const CornerNumbers numbers = corners.next();
        PlacedColumns group;
        with_table_groups<Leaf::max_vertices>(leaf.vertex_count, [&](auto used) {
            look_up_all<used>(coordinates, numbers, group.corner[0]);
            return 0;
        });
        const auto used = static_cast<unsigned>(leaf.used_slots() >> first) & ((1u << lanes) - 1u);
        for (unsigned near = lanes_near(group.corner[0], box, true, 0.0f) & used; near != 0; near &= near - 1) {
            const auto lane = static_cast<unsigned>(std::countr_zero(near));
            for (int i = 0; i < 3; ++i)
                for (int k = 0; k < 3; ++k) placed.set(count, i, k, group.at(lane, i, k));
            placed.slot[count++] = static_cast<std::uint8_t>(first + lane);
        }
        first += lanes;
    } while (first < leaf.slot_count && count + lanes <= PlacedTriangles::most);
    return count;
}

/// The next triangles of a leaf of b: a bit for each place of one that is near enough to the box to touch what is in
/// it. Moves `first` behind them.
template <class Leaf, class Corners>
inline unsigned place_near(const Leaf& leaf, PairLeaf place, const PairFrame& frame, const PlacedBox& box,
                           Corners& corners, unsigned& first, PlacedTriangles& placed) {
    if (leaf.slot_count > PlacedTriangles::most) {
        placed.whole = no_leaf;
        return (1u << place_some_of_b(leaf, frame, box, corners, first, placed)) - 1u;
    }
    if (placed.whole != place) {
        place_triangles_of_b(leaf, frame, corners, placed);
        placed.whole = place;
    }
    first = leaf.slot_count;
    unsigned near = 0;
    for (unsigned group = 0; group < groups_of_slots(leaf.slot_count); ++group)
        near |= lanes_near(placed.group(group), box, true, 0.0f) << group * lanes;
    return near & static_cast<unsigned>(leaf.used_slots());
}

ESPALIER_END_SET

#endif
