// Oriented boxes against nodes and triangles in lanes: separating axes in float, with bounds on what they round
// (docs/numerics.md, *Oriented boxes in lanes*). What these leave open is decided by the exact kernel, whose products
// of 128 bits take a hundred times as long.
#ifndef ESPALIER_OVERLAP_ORIENTED_BOX_QUERIES_HPP
#define ESPALIER_OVERLAP_ORIENTED_BOX_QUERIES_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/overlap/rounded_shapes.hpp>
#include <runtime/proximity/point_bounds.hpp>
#include <runtime/traversal/find.hpp>
#include <runtime/traversal/node_boxes.hpp>

ESPALIER_BEGIN_SET

#if ESPALIER_LANES == 16

using avx2::children_meeting;  // a packed node has eight children

#else

/// The children, of those in the mask, that no plane of the box's faces separates from it.
template <class Node>
inline unsigned children_meeting(const Node& node, const FloatOrientedBox& box, const BlobData& blob, unsigned mask) {
    const auto boxes = boxes_of(node, blob);
    unsigned meeting = 0;
    for (unsigned first = 0; first < Node::max_children; first += lanes) {
        Floats middle[3], size[3], reach = splat(box.size);  // middle and size are twice what they are
        for (int k = 0; k < 3; ++k) {
            const Floats low = boxes.low(k, first), high = boxes.high(k, first),
                         center = splat(box.rounded.center_steps[k]);
            middle[k] = add(subtract(low, center), subtract(high, center));
            size[k] = subtract(high, low);
            reach = add(add(magnitude(middle[k]), size[k]), reach);
        }
        const Floats slack = multiply(reach, splat(box.size * box.size * 0x1p-19f));
        Floats beyond = splat(-infinity);
        for (const auto& normal : box.normal) {
            Floats apart = splat(0.0f), covered = splat(2.0f * box.face);
            for (int k = 0; k < 3; ++k) {
                const Floats along = splat(normal[k]);
                apart = multiply_add(along, middle[k], apart);
                covered = multiply_add(magnitude(along), size[k], covered);
            }
            beyond = larger(subtract(subtract(magnitude(apart), covered), slack), beyond);
        }
        meeting |= at_most(beyond, splat(0.0f)) << first;
    }
    return mask & meeting;
}

#endif

/// Whether each axis surely separates triangles from a box, or surely does not: of each, the largest gap less what it
/// may be off by, and more. Of a gap only the sign counts, so that axes need not have length 1.
struct AxisGaps {
    Floats least = splat(-infinity);
    Floats most = splat(-infinity);

    void add_axis(Floats gap, Floats slack) {
        least = larger(subtract(gap, slack), least);
        most = larger(add(gap, slack), most);
    }
    /// `low` and `high` are how far the triangles reach along the axis, `reach` is how far the box does.
    void add_axis(Floats low, Floats high, Floats reach, Floats slack) {
        add_axis(subtract(larger(low, negate(high)), reach), slack);
    }
};

/// The thirteen axes of a box and triangles, seen from its center (Gottschalk, Lin and Manocha 1996).
inline AxisGaps gaps_of(const FloatOrientedBox& box, const CornersFromPoint& t, Floats reach) {
    AxisGaps gaps;
    const Floats3* const corner[3] = {&t.a, &t.b, &t.c};
    const Floats far = add(reach, splat(box.size));
    Floats at[3][3];  // corners along the normals of the faces
    for (int i = 0; i < 3; ++i) {
        const Floats3 normal = splat_each(box.normal[i]);
        for (int j = 0; j < 3; ++j) at[i][j] = dot(normal, *corner[j]);
        gaps.add_axis(smaller(at[i][0], smaller(at[i][1], at[i][2])), larger(at[i][0], larger(at[i][1], at[i][2])),
                      splat(box.face), multiply(far, splat(box.size * box.size * 0x1p-19f)));
    }
    const Floats3 normal = cross(subtract(t.b, t.a), subtract(t.c, t.a));
    Floats along[3], sum = splat(0.0f);  // half axes along the normal of the triangle
    Floats3 half[3];
    for (int i = 0; i < 3; ++i) {
        half[i] = splat_each(box.rounded.half_steps[i]);
        along[i] = dot(half[i], normal);
        sum = add(magnitude(along[i]), sum);
    }
    const Floats slack = multiply(multiply(far, reach), splat(0x1p-16f));
    gaps.add_axis(subtract(magnitude(dot(normal, t.a)), sum), multiply(slack, reach));
    // Across a half axis and a side the ends of the side are equally far, and the third corner is farther by `along`.
    const Floats slack_across = multiply(slack, splat(box.size));
    for (int j = 0; j < 3; ++j) {
        const int next = j == 2 ? 0 : j + 1;
        const Floats3 moment = cross(subtract(*corner[next], *corner[j]), *corner[j]);
        Floats side[3];
        for (int i = 0; i < 3; ++i) side[i] = magnitude(subtract(at[i][next], at[i][j]));
        for (int i = 0; i < 3; ++i) {
            const Floats end = dot(half[i], moment), third = add(end, along[i]);
            gaps.add_axis(smaller(end, third), larger(end, third),
                          add(side[i == 2 ? 0 : i + 1], side[i == 0 ? 2 : i - 1]), slack_across);
        }
    }
    return gaps;
}

template <unsigned groups, class Leaf>
ESPALIER_NOINLINE inline OverlapCandidates<typename Leaf::Slots> candidates_of(const Leaf& leaf,
                                                                               const FloatOrientedBox& box) {
    using Slots = typename Leaf::Slots;
    OverlapCandidates<Slots> candidates;
    for_each_group_of<groups>(leaf, box.rounded.center_steps, [&](unsigned first, const CornersFromPoint& t) {
        const BoxesFromPoint around(t);
        Floats beyond = splat(-infinity);
        for (int k = 0; k < 3; ++k)
            beyond = larger(subtract(larger(around.low[k], negate(around.high[k])), splat(box.spread[k])), beyond);
        const Floats reach = around.reach();
        beyond = subtract(beyond, multiply(add(reach, splat(box.size)), splat(0x1p-20f)));
        if (at_most(beyond, splat(0.0f)) == 0) return;
        const AxisGaps gaps = gaps_of(box, t, reach);
        candidates.near |= Slots{at_most(larger(gaps.least, beyond), splat(0.0f))} << first;
        candidates.sure |= Slots{at_most(gaps.most, splat(0.0f))} << first;
    });
    candidates.near &= leaf.used_slots();
    return candidates;
}

struct OrientedBoxShape {
    const BlobData& blob;
    Rounded<OrientedBox>& rounded;
    FloatOrientedBox box;
    bool has_faces = false;

    OrientedBoxShape(const BlobData& of, Rounded<OrientedBox>& from) : blob(of), rounded(from), box(from) {}
    template <class Node>
    [[nodiscard]] unsigned cull(const Node& node, float, float*) const {
        const unsigned mask = children_within(node, blob.bits, rounded.bounds);
        // Where triangles have duplicate references, the nodes that are reached decide on their order. Small code
        // reaches the same ones.
        return mask == 0 || blob.copies != nullptr ? mask : children_meeting(node, box, blob, mask);
    }
    template <class Leaf>
    [[nodiscard]] Visit scan(const Leaf& leaf, Each& answer) {
        const auto candidates = with_table_groups<Leaf::max_vertices>(
            leaf.vertex_count, [&](auto groups) { return (candidates_of<groups>)(leaf, box); });
        return take_candidates(leaf, candidates, answer, [&](unsigned slot) {
            count_decision();
            if (!has_faces) add_faces(rounded);
            has_faces = true;
            return meets(rounded, leaf.triangle(slot));
        });
    }
};

ESPALIER_QUERY_OF_SET bool find_overlaps_of_box(const BlobData& blob, Rounded<OrientedBox>& box, Each& answer,
                                                const WalkAccuracy& accuracy) {
    OrientedBoxShape shape(blob, box);
    return find_each<Each>(blob, shape, answer, accuracy);
}

ESPALIER_END_SET

#endif
