// How near two triangles may be, by what they cover along directions and by their corners, in lanes.
#ifndef ESPALIER_PAIRS_CORNERS_HPP
#define ESPALIER_PAIRS_CORNERS_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/pairs/leaves.hpp>

ESPALIER_BEGIN_SET

/// Coordinates are below 2^24, and three products with a direction of length 1 are off by less than this.
inline constexpr float along_slack = 32.0f;

/// What triangles cover along a direction.
struct Shadow {
    Floats low, high;
    ESPALIER_ALWAYS_INLINE Shadow(const PlacedLanes& t, const float* axis) {
        const auto along = [&](const Floats* corner) {
            return add(add(multiply(corner[0], splat(axis[0])), multiply(corner[1], splat(axis[1]))),
                       multiply(corner[2], splat(axis[2])));
        };
        const Floats a = along(t.corner[0]), b = along(t.corner[1]), c = along(t.corner[2]);
        low = least(a, b, c);
        high = most(a, b, c);
    }
};

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
ESPALIER_ALWAYS_INLINE inline Floats gap_along_axes(const PlacedLanes& t, const PlacedLanes& other,
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

/// Returns the squared distance of the two nearest corners.
ESPALIER_ALWAYS_INLINE inline Floats squared_of_nearest_corners(const PlacedLanes& t, const PlacedLanes& other) {
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

ESPALIER_END_SET

#endif
