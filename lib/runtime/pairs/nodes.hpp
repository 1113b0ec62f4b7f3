// A box of the one tree against the boxes of a node of the other, in lanes. Planes are exact, so that fusing them
// changes nothing; nothing else is fused. The same pairs are visited on every machine.
#ifndef ESPALIER_PAIRS_NODES_HPP
#define ESPALIER_PAIRS_NODES_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/pairs/queries.hpp>
#include <runtime/traversal/node_boxes.hpp>
#include <runtime/traversal/traverse.hpp>

ESPALIER_BEGIN_SET

/// A box of the other tree, seen from this one's frame: its center, its half sides along its own axes, and their reach
/// along the frame's, slack included.
struct SeenBox {
    alignas(register_alignment) float center[PairSide::row];
    alignas(register_alignment) float half[PairSide::row];
    alignas(register_alignment) float reach[PairSide::row];
};

/// A box in the lattice of its own tree: center and half sides, times 2.
struct TwiceBox {
    float center[3];
    float half[3];
};

template <class Node>
ESPALIER_SHARED_CODE inline TwiceBox load_twice_box(const Node& node, unsigned child, const BlobData& blob) {
    TwiceBox box;
    for (int k = 0; k < 3; ++k) {
        const auto low = static_cast<float>(node.low(k, child, blob.bits));
        const auto high = static_cast<float>(node.high(k, child, blob.bits));
        box.center[k] = low + high;
        box.half[k] = high - low;
    }
    return box;
}

ESPALIER_SHARED_CODE inline SeenBox see_box(const TwiceBox& box, const PairSide& side) {
    SeenBox seen;
    const float half_scale = 0.5f * side.scale;
#if ESPALIER_SMALL_CODE
    // mutant(< -> <=) sanitizer: reads or writes a fourth coordinate behind three
    for (int k = 0; k < 3; ++k) seen.half[k] = box.half[k] * half_scale;
    for (int k = 0; k < 3; ++k) {
        seen.center[k] =
            (side.at(k, 0) * box.center[0] + side.at(k, 1) * box.center[1] + side.at(k, 2) * box.center[2]) *
                half_scale +
            side.offset[k];
        seen.reach[k] = side.absolute_at(k, 0) * seen.half[0] + side.absolute_at(k, 1) * seen.half[1] +
                        side.absolute_at(k, 2) * seen.half[2] + side.slack;
    }
#else
    const float half[3] = {box.half[0] * half_scale, box.half[1] * half_scale, box.half[2] * half_scale};
    const auto combined = [](const float(*axes)[PairSide::row], const float* weights) {
        return load_as<Axes>(axes[0]) * weights[0] + load_as<Axes>(axes[1]) * weights[1] +
               load_as<Axes>(axes[2]) * weights[2];
    };
    store_axes(seen.center, combined(side.axis, box.center) * half_scale + load_as<Axes>(side.offset));
    store_axes(seen.half, Axes{half[0], half[1], half[2], 0.0f});
    store_axes(seen.reach, combined(side.absolute_axis, half) + side.slack);
#endif
    return seen;
}

#if !ESPALIER_SMALL_CODE
/// How far a box reaches along the cross products of an axis of each: for the other's axis j a row of the frame's.
struct CrossReach {
    alignas(register_alignment) float of[3][PairSide::row];

    CrossReach(const SeenBox& seen, const PairSide& side) {
        for (int j = 0; j < 3; ++j) {
            const int j1 = j == 2 ? 0 : j + 1, j2 = j == 0 ? 2 : j - 1;
            store_axes(of[j], load_as<Axes>(side.absolute_axis[j2]) * seen.half[j1] +
                                  load_as<Axes>(side.absolute_axis[j1]) * seen.half[j2] + 3.0f * side.slack);
        }
    }
    [[nodiscard]] float at(int i, int j) const { return of[j][i]; }
};
#else
/// The reach across a pair of axes, computed where it is needed: small code has no room to keep it.
struct CrossReach {
    const SeenBox& seen;
    const PairSide& side;

    CrossReach(const SeenBox& of, const PairSide& from) : seen(of), side(from) {}
    [[nodiscard]] ESPALIER_ALWAYS_INLINE float at(int i, int j) const {
        const int j1 = j == 2 ? 0 : j + 1, j2 = j == 0 ? 2 : j - 1;
        return seen.half[j1] * side.absolute_at(i, j2) + seen.half[j2] * side.absolute_at(i, j1) + 3.0f * side.slack;
    }
};
#endif

/// Boxes in lanes.
struct LaneBoxes {
    Floats center[3];
    Floats half[3];
};

/// Returns lower bounds of the squared distance to the boxes, measured along the axes of both trees. Where those along
/// our own axes are beyond the limit in every lane, the other axes are left out.
ESPALIER_SHARED_CODE inline Floats gap_to(const LaneBoxes& boxes, const SeenBox& seen, const PairSide& side,
                                          float limit, Floats* apart) {
    const Floats zero = splat(0.0f);
    Floats own = zero;
    count_axes(3);
    for (int k = 0; k < 3; ++k) {
        apart[k] = subtract(boxes.center[k], splat(seen.center[k]));
        const Floats gap = larger(subtract(subtract(magnitude(apart[k]), boxes.half[k]), splat(seen.reach[k])), zero);
        own = add(own, multiply(gap, gap));
    }
    if (at_most(own, splat(limit)) == 0) return own;
    Floats others = zero;
    count_axes(3);
    for (int j = 0; j < 3; ++j) {
        const auto along = [&](int i) { return splat(side.at(i, j)); };
        const auto absolute_along = [&](int i) { return splat(side.absolute_at(i, j)); };
        const Floats distance = magnitude(
            add(add(multiply(apart[0], along(0)), multiply(apart[1], along(1))), multiply(apart[2], along(2))));
        const Floats reach =
            add(add(multiply(boxes.half[0], absolute_along(0)), multiply(boxes.half[1], absolute_along(1))),
                multiply(boxes.half[2], absolute_along(2)));
        const Floats gap = larger(subtract(subtract(distance, reach), splat(seen.half[j] + 2.0f * side.slack)), zero);
        others = add(others, multiply(gap, gap));
    }
    return larger(own, others);
}

/// Whether a cross product of an axis of each has the boxes apart. Axes that are nearly parallel have a product of
/// nearly no length: then both sides of the comparison are small, and the slack decides that they are not.
ESPALIER_SHARED_CODE inline unsigned not_apart_across(const LaneBoxes& boxes, const CrossReach& cross_reach,
                                                      const PairSide& side, const Floats* apart) {
    Floats most = splat(-infinity);
    for (int i = 0; i < 3; ++i) {
        const int i1 = i == 2 ? 0 : i + 1, i2 = i == 0 ? 2 : i - 1;
        count_axes(3);
        for (int j = 0; j < 3; ++j) {
            const Floats distance = magnitude(
                subtract(multiply(apart[i2], splat(side.at(i1, j))), multiply(apart[i1], splat(side.at(i2, j)))));
            const Floats reach = add(multiply(boxes.half[i1], splat(side.absolute_at(i2, j))),
                                     multiply(boxes.half[i2], splat(side.absolute_at(i1, j))));
            most = larger(subtract(subtract(distance, reach), splat(cross_reach.at(i, j))), most);
        }
        if constexpr (lanes == 1)
            if (at_most(most, splat(0.0f)) == 0) return 0;
    }
    return at_most(most, splat(0.0f));
}

/// How far apart boxes are along the directions, squared.
ESPALIER_SHARED_CODE inline Floats gap_along(const PairAxes& axes, const LaneBoxes& boxes, const SeenBox& seen,
                                             const PairSide& side, const Floats* apart) {
    Floats sum = splat(0.0f);
    count_axes(3);
    for (const auto& axis : axes.at) {
        float reach = 2.0f * side.slack;
        for (int j = 0; j < 3; ++j)
            reach +=
                absolute(axis[0] * side.at(0, j) + axis[1] * side.at(1, j) + axis[2] * side.at(2, j)) * seen.half[j];
        Floats along = splat(0.0f), own_reach = splat(reach);
        for (int k = 0; k < 3; ++k) {
            along = add(along, multiply(apart[k], splat(axis[k])));
            own_reach = add(own_reach, multiply(boxes.half[k], splat(absolute(axis[k]))));
        }
        const Floats gap = larger(subtract(magnitude(along), own_reach), splat(0.0f));
        sum = add(sum, multiply(gap, gap));
    }
    return sum;
}

/// The weight of the distance between centers, beside the gap between boxes, in the order of children: most boxes far
/// up have no gap.
inline constexpr float share_of_centers = 0x1p-4f;

/// The children of a node that are within the squared distance, and what orders them: for contacts how far the centers
/// are apart, for distances, which have axes, the gap and a share of that.
template <class Node>
ESPALIER_NOINLINE unsigned children_near(const Node& node, const BlobData& blob, const SeenBox& seen,
                                         const PairSide& side, const PairAxes* axes, float limit, float* keys) {
    const auto all = boxes_of(node, blob);
    const Floats half_scale = splat(0.5f * side.own_scale);
    const unsigned children = all_children(node);
    const CrossReach cross_reach(seen, side);
    unsigned mask = 0;
    for (unsigned first = 0; children >> first != 0; first += lanes) {
        LaneBoxes boxes;  // on the side's grid
        for (int k = 0; k < 3; ++k) {
            const Floats low = all.low(k, first), high = all.high(k, first);
            boxes.center[k] = multiply(add(low, high), half_scale);
            boxes.half[k] = multiply(subtract(high, low), half_scale);
        }
        Floats apart[3];
        Floats gap = gap_to(boxes, seen, side, limit, apart);
        if (at_most(gap, splat(limit)) == 0) continue;
        if (axes != nullptr) gap = larger(gap, gap_along(*axes, boxes, seen, side, apart));
        unsigned near = at_most(gap, splat(limit));
        const Floats between =
            add(add(multiply(apart[0], apart[0]), multiply(apart[1], apart[1])), multiply(apart[2], apart[2]));
        if (axes == nullptr) {
            near &= not_apart_across(boxes, cross_reach, side, apart);
            store(keys + first, between);
        } else {
            store(keys + first, add(gap, multiply(between, splat(share_of_centers))));
        }
        mask |= near << first;
    }
    return mask & children;
}

ESPALIER_END_SET

#endif
