// Distances from a point to boxes, in lanes.
#ifndef ESPALIER_PROXIMITY_SQUARED_DISTANCE_HPP
#define ESPALIER_PROXIMITY_SQUARED_DISTANCE_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/traversal/traverse.hpp>

ESPALIER_BEGIN_SET

/// Squared distance from the origin to boxes, given by planes relative to it.
inline Floats squared_distance(const Floats* low, const Floats* high) {
    Floats sum = splat(0.0f);
    for (int k = 0; k < 3; ++k) {
        const Floats gap = larger(larger(low[k], negate(high[k])), splat(0.0f));
        sum = add(multiply(gap, gap), sum);
    }
    return sum;
}

/// Squared distance from the origin to the farthest corners of boxes.
inline Floats squared_distance_of_far_corner(const Floats* low, const Floats* high) {
    Floats sum = splat(0.0f);
    // mutant(< -> <=) sanitizer: reads or writes a fourth coordinate behind three
    for (int k = 0; k < 3; ++k) {
        const Floats reach = larger(high[k], negate(low[k]));
        sum = add(multiply(reach, reach), sum);
    }
    return sum;
}

ESPALIER_END_SET

#endif
