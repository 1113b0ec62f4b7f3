// Distances from a point to the boxes of a node, in lanes.
#ifndef ESPALIER_PROXIMITY_POINT_NODES_HPP
#define ESPALIER_PROXIMITY_POINT_NODES_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/lattice/round_point.hpp>
#include <runtime/traversal/node_boxes.hpp>

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

#if ESPALIER_LANES == 16

using avx2::distance_test;  // a packed node has eight children
using avx2::overlap_test;

#else

/// The planes of a group of children, seen from the point. Planes are exact; the difference to the point, which may be
/// far away, rounds once.
template <class Boxes>
ESPALIER_ALWAYS_INLINE inline void planes_from_point(const Boxes& boxes, const RoundedPoint& point, unsigned first,
                                                     Floats* low, Floats* high) {
    for (int k = 0; k < 3; ++k) {
        const Floats from = splat(point.steps[k]);
        low[k] = subtract(boxes.low(k, first), from);
        high[k] = subtract(boxes.high(k, first), from);
    }
}

/// Returns what distance_test() does, child by child, and stops at the first axis that rules a child out.
template <class Node>
inline unsigned distance_test_one_by_one(const Node& node, const RoundedPoint& point, const BlobData& blob, float limit,
                                         float* distances) {
    const auto boxes = boxes_of(node, blob);
    const unsigned count = node.node_children() + node.leaf_children();
    unsigned mask = 0;
    for (unsigned child = 0; child < count; ++child) {
        Floats squared = splat(0.0f);
        unsigned near = 1;
        // mutant(< -> <=) sanitizer: reads a fourth coordinate behind three
        for (int k = 0; k < 3 && near != 0; ++k) {
            const Floats from = splat(point.steps[k]);
            Floats gap = subtract(boxes.low(k, child), from);
            if (at_most(gap, splat(0.0f)) != 0) gap = subtract(from, boxes.high(k, child));
            if (at_most(gap, splat(0.0f)) != 0) continue;
            squared = add(multiply(gap, gap), squared);
            near = at_most(squared, splat(limit));
        }
        mask |= near << child;
        store(distances + child, squared);
    }
    return mask;
}

/// The children whose box is within the limit, and the squared distance of each.
template <class Node>
inline unsigned distance_test(const Node& node, const RoundedPoint& point, const BlobData& blob, float limit,
                              float* distances) {
    if constexpr (small_code) return distance_test_one_by_one(node, point, blob, limit, distances);
    const auto boxes = boxes_of(node, blob);
    unsigned mask = 0;
    for (unsigned first = 0; first < Node::max_children; first += lanes) {
        Floats low[3], high[3];
        planes_from_point(boxes, point, first, low, high);
        const Floats distance = squared_distance(low, high);
        mask |= at_most(distance, splat(limit)) << first;
        store(distances + first, distance);
    }
    return mask & all_children(node);
}

/// The children whose box is within the point's radius, and of these the ones that are clearly inside of it altogether.
template <class Node>
inline unsigned overlap_test(const Node& node, const RoundedPoint& point, const BlobData& blob, unsigned& inside) {
    const auto boxes = boxes_of(node, blob);
    unsigned mask = 0, clearly_inside = 0;
    // mutant(< -> <=) equivalent: tests one more child from the bytes behind the node and masks it out
    for (unsigned first = 0; first < Node::max_children; first += lanes) {
        Floats low[3], high[3];
        planes_from_point(boxes, point, first, low, high);
        mask |= at_most(squared_distance(low, high), splat(point.limit)) << first;
        // mutant(|= nothing) work: tests each triangle of a box that is wholly inside, with the same result
        clearly_inside |= at_most(squared_distance_of_far_corner(low, high), splat(point.inner_limit)) << first;
    }
    inside = clearly_inside;
    return mask & all_children(node);
}

#endif

ESPALIER_END_SET

#endif
