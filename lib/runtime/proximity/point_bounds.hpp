// Triangles of a leaf in lanes, seen from a point, and bounds on their distance.
#ifndef ESPALIER_PROXIMITY_POINT_BOUNDS_HPP
#define ESPALIER_PROXIMITY_POINT_BOUNDS_HPP

#include <runtime/lanes/set.hpp>

ESPALIER_BEGIN_SET

/// Three coordinates, or a triangle's corners, seen from the point: a triangle in each lane.
struct Floats3 {
    Floats x, y, z;
};
struct CornersFromPoint {
    Floats3 a, b, c;
};

/// Boxes of triangles, seen from the point.
struct BoxesFromPoint {
    Floats low[3], high[3];
    explicit BoxesFromPoint(const CornersFromPoint& t) {
        const auto set = [&](int k, Floats a, Floats b, Floats c) {
            low[k] = smaller(a, smaller(b, c));
            high[k] = larger(a, larger(b, c));
        };
        set(0, t.a.x, t.b.x, t.c.x);
        set(1, t.a.y, t.b.y, t.c.y);
        set(2, t.a.z, t.b.z, t.c.z);
    }
    /// At least the sum of the absolute coordinates of any corner.
    [[nodiscard]] Floats reach() const {
        Floats sum = splat(0.0f);
        for (int k = 0; k < 3; ++k) sum = add(sum, larger(high[k], negate(low[k])));
        return sum;
    }
};

/// Calls `on_group(first slot, corners)` for a leaf's triangles, seen from a point. The table has room for the vertices
/// of this leaf, or of `any_leaf`.
template <unsigned groups, bool any_leaf = false, class Leaf, class OnGroup>
ESPALIER_ALWAYS_INLINE inline void for_each_group_of(const Leaf& leaf, const float* steps, OnGroup on_group) {
    Table<groups> coordinates[3];
    unsigned used = Table<groups>::groups_of(leaf.vertex_count);
    if constexpr (any_leaf) {
        used = (leaf.vertex_count + lanes - 1) / lanes;
        for (auto& table : coordinates)
            for (unsigned group = 0; group < groups; ++group) table.set(group, splat(0.0f));
    }
    for (unsigned k = 0; k < 3; ++k) {
        const auto anchor = static_cast<std::uint32_t>(leaf.anchor(static_cast<int>(k)));
        const Floats from = splat(steps[k]);
        for (unsigned group = 0; group < used; ++group) {
            coordinates[k].set(group, subtract(to_floats(add(offsets_of(leaf, k, group), anchor)), from));
        }
    }
    auto corners = corners_of(leaf);
    for (unsigned first = 0; first < leaf.slot_count; first += lanes) {
        const auto numbers = corners.next();
        const auto look_up = [&](const Numbers& number) {
            return Floats3{coordinates[0].look_up(number), coordinates[1].look_up(number),
                           coordinates[2].look_up(number)};
        };
        on_group(first, CornersFromPoint{look_up(numbers.a), look_up(numbers.b), look_up(numbers.c)});
    }
}

inline Floats dot(const Floats3& a, const Floats3& b) {
    return multiply_add(a.x, b.x, multiply_add(a.y, b.y, multiply(a.z, b.z)));
}
inline Floats3 subtract(const Floats3& a, const Floats3& b) {
    return {subtract(a.x, b.x), subtract(a.y, b.y), subtract(a.z, b.z)};
}

inline Floats3 splat_each(const float* a) { return {splat(a[0]), splat(a[1]), splat(a[2])}; }
inline Floats3 negate(const Floats3& a) { return {negate(a.x), negate(a.y), negate(a.z)}; }
inline Floats3 cross(const Floats3& a, const Floats3& b) {
    return {multiply_subtract(a.y, b.z, multiply(a.z, b.y)), multiply_subtract(a.z, b.x, multiply(a.x, b.z)),
            multiply_subtract(a.x, b.y, multiply(a.y, b.x))};
}
/// The sum of the absolute coordinates: at least the length.
inline Floats length_bound(const Floats3& a) { return add(magnitude(a.x), add(magnitude(a.y), magnitude(a.z))); }
inline Floats largest_of(Floats a, Floats b, Floats c) { return larger(larger(a, b), c); }

/// Any direction bounds the squared distance of a convex body from below: nothing of it is nearer than its corner that
/// is least far along. `reach` is at least the sum of a corner's coordinates; it bounds what all of this can round.
inline Floats lower_bound_along(const Floats3& direction, const CornersFromPoint& t, Floats reach) {
    const Floats to_a = dot(direction, t.a), to_b = dot(direction, t.b), to_c = dot(direction, t.c);
    const Floats least = larger(smaller(to_a, smaller(to_b, to_c)), negate(larger(to_a, larger(to_b, to_c))));
    const Floats rounding = multiply(multiply(length_bound(direction), splat(0x1p-21f)), reach);
    const Floats along = larger(subtract(least, rounding), splat(0.0f));
    // No squared length of a direction that matters is as small as this.
    return multiply(along, divide(along, larger(dot(direction, direction), splat(0x1p-60f))));
}

/// The point of the side from a to b that is closest, nearly.
inline Floats3 closest_on_side(const Floats3& a, const Floats3& b) {
    const Floats3 side = subtract(b, a);
    // Sides are whole lattice steps: where they seem shorter the point is too far away to tell.
    const Floats along = divide(negate(dot(a, side)), larger(dot(side, side), splat(1.0f)));
    const Floats share = larger(smaller(along, splat(1.0f)), splat(0.0f));
    return {multiply_add(share, side.x, a.x), multiply_add(share, side.y, a.y), multiply_add(share, side.z, a.z)};
}

/// Puts another point in the place of the closest one if that is not nearer.
inline void offer(const Floats3& other, Floats3& closest, Floats& squared) {
    const Floats other_squared = dot(other, other);
    closest = {where_at_most(other_squared, squared, other.x, closest.x),
               where_at_most(other_squared, squared, other.y, closest.y),
               where_at_most(other_squared, squared, other.z, closest.z)};
    squared = smaller(other_squared, squared);
}
/// The closest point of the sides, nearly, and its squared distance.
inline Floats3 closest_on_sides(const Floats3& a, const Floats3& b, const Floats3& c, Floats& squared) {
    Floats3 closest = closest_on_side(a, b);
    squared = dot(closest, closest);
    offer(closest_on_side(b, c), closest, squared);
    offer(closest_on_side(c, a), closest, squared);
    return closest;
}

/// A lower bound of the squared distance, from the plane and from the closest point of the sides: one of them is tight.
/// `squared_to_sides` is about what the sides alone give.
inline Floats lower_bound(const CornersFromPoint& t, Floats reach, Floats& squared_to_sides) {
    const Floats3 closest = closest_on_sides(t.a, t.b, t.c, squared_to_sides);
    const Floats3 normal = cross(subtract(t.b, t.a), subtract(t.c, t.a));
    return larger(lower_bound_along(closest, t, reach), lower_bound_along(normal, t, reach));
}

ESPALIER_END_SET

#endif
