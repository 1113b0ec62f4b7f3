// Distances from a segment or a box to the boxes of a node, in lanes.
#ifndef ESPALIER_PROXIMITY_PAIR_NODES_HPP
#define ESPALIER_PROXIMITY_PAIR_NODES_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/proximity/closest_pair.hpp>
#include <runtime/proximity/point_nodes.hpp>

ESPALIER_BEGIN_SET

#if ESPALIER_LANES == 16

using avx2::pair_test;  // as in point_nodes.hpp

#else

/// The children of a node whose box is within the limit of the shape, and a bound on the squared distance of each: from
/// the gaps along the axes and, of a segment, along the directions across it and one axis.
template <class Node>
inline unsigned pair_test(const Node& node, const DistantShape& shape, const BlobData& blob, float limit,
                          float* distances) {
    const auto boxes = boxes_of(node, blob);
    const float* const from = shape.segment.from_steps;
    unsigned mask = 0;
    for (unsigned first = 0; first < Node::max_children; first += lanes) {
        Floats low[3], high[3], bound = splat(0.0f);
        for (int k = 0; k < 3; ++k) {
            low[k] = boxes.low(k, first);
            high[k] = boxes.high(k, first);
            const Floats below = subtract(low[k], splat(shape.highest[k])),
                         above = subtract(splat(shape.lowest[k]), high[k]);
            const Floats gap = larger(larger(below, above), splat(0.0f));
            bound = add(multiply(gap, gap), bound);
        }
        if (!shape.is_box && at_most(bound, splat(limit)) != 0) {
            Floats middle[3], size[3], reach[3];  // all of these twice as large as they should be
            for (int k = 0; k < 3; ++k) {
                const Floats to_low = subtract(low[k], splat(from[k])), to_high = subtract(high[k], splat(from[k]));
                middle[k] = add(to_low, to_high);
                size[k] = subtract(high[k], low[k]);
                reach[k] = add(magnitude(to_low), magnitude(to_high));
            }
            for (int axis = 0; axis < 3; ++axis) {
                const int y = axis == 2 ? 0 : axis + 1, z = axis == 0 ? 2 : axis - 1;
                const Floats at_y = splat(shape.across[axis][y]), at_z = splat(shape.across[axis][z]);
                const Floats length_y = magnitude(at_y), length_z = magnitude(at_z);
                const Floats apart = magnitude(add(multiply(at_y, middle[y]), multiply(at_z, middle[z])));
                const Floats covered = add(multiply(length_y, size[y]), multiply(length_z, size[z]));
                const Floats slack =
                    multiply(add(multiply(length_y, reach[y]), multiply(length_z, reach[z])), splat(0x1p-19f));
                const Floats gap =
                    multiply(larger(subtract(subtract(apart, covered), slack), splat(0.0f)), splat(0.5f));
                bound = larger(multiply(gap, gap), bound);
            }
        }
        mask |= at_most(bound, splat(limit)) << first;
        store(distances + first, bound);
    }
    return mask & all_children(node);
}

#endif

ESPALIER_END_SET

#endif
