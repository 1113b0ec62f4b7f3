// Spheres and closest points: the tests of triangles in lanes, and the queries as visitors. Lanes reject what is
// clearly too far away and accept what is clearly near enough; what they leave open is decided by point_triangle.hpp.
#ifndef ESPALIER_PROXIMITY_POINT_SEARCH_HPP
#define ESPALIER_PROXIMITY_POINT_SEARCH_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/proximity/point_bounds.hpp>
#include <runtime/proximity/point_nodes.hpp>
#include <runtime/proximity/triangle_gap.hpp>
#include <runtime/traversal/find.hpp>

ESPALIER_BEGIN_SET

template <unsigned groups, class Leaf>
ESPALIER_NOINLINE inline OverlapCandidates<typename Leaf::Slots> overlap_candidates_of(const Leaf& leaf,
                                                                                       const RoundedPoint& point) {
    using Slots = typename Leaf::Slots;
    OverlapCandidates<Slots> candidates;
    for_each_group_of<groups>(leaf, point.steps, [&](unsigned first, const CornersFromPoint& t) {
        const BoxesFromPoint boxes(t);
        candidates.near |= Slots{at_most(squared_distance(boxes.low, boxes.high), splat(point.limit))} << first;
        const Floats nearest_corner = smaller(dot(t.a, t.a), smaller(dot(t.b, t.b), dot(t.c, t.c)));
        candidates.sure |= Slots{at_most(nearest_corner, splat(point.inner_limit))} << first;
    });
    candidates.near &= leaf.used_slots();
    return candidates;
}

/// What of the surface is within the radius, by whichever point.
struct SphereShape {
    const RoundedPoint& sphere;
    const BlobData& blob;
    unsigned inside = 0;  ///< the children of the node at hand that are, box and all

    template <class Node>
    unsigned cull(const Node& node, float, float*) {
        return overlap_test(node, sphere, blob, inside);
    }
    template <class Leaf, class SomeAnswer>
    ESPALIER_SHARED_OR_PART_OF_CALLER Visit scan(const Leaf& leaf, SomeAnswer& answer) const {
        using Slots = typename Leaf::Slots;
        OverlapCandidates<Slots> candidates = {leaf.used_slots(), ~Slots{0}};
        // mutant(== -> true) work: tests each triangle of a box that is wholly inside, with the same result
        if ((inside >> leaf.child() & 1u) == 0)
            candidates = with_table_groups<Leaf::max_vertices>(
                leaf.vertex_count, [&](auto groups) { return overlap_candidates_of<groups>(leaf, sphere); });
        return take_candidates(leaf, candidates, answer, [&](unsigned slot) {
            return is_within_radius(sphere, distance_to(sphere, leaf.triangle(slot)), sphere.radius);
        });
    }
};

/// Bounds on the squared distances of triangles from the point that they are seen from.
struct PointBounds {
    static constexpr bool is_costly = false;
    static Floats quick(const BoxesFromPoint& boxes) { return squared_distance(boxes.low, boxes.high); }
    /// `nearest` is about what their sides give.
    static Floats tight(const CornersFromPoint& t, const BoxesFromPoint& boxes, Floats& nearest) {
        if constexpr (lanes > 1) return lower_bound(t, boxes.reach(), nearest);
        nearest = smaller(dot(t.a, t.a), smaller(dot(t.b, t.b), dot(t.c, t.c)));  // a bound costs as much as a decision
        return splat(0.0f);
    }
};

/// What lanes tell of the triangles of a leaf that may be within a limit: a lower bound of each squared distance, and
/// about what their sides give.
template <class Leaf>
struct LeafDistances {
    static constexpr unsigned room = (Leaf::max_slots + lanes - 1) / lanes * lanes;
    float lower[room];
    float to_sides[room];

    /// Costly bounds hide what a larger table takes: one function for all leaves is a sixth of the code.
    template <class Bounds>
    static constexpr bool any_leaf = Bounds::is_costly&& lanes > 4;

    /// Which triangles these are; the others' places stay as they are.
    template <unsigned groups, class Bounds>
    ESPALIER_NOINLINE typename Leaf::Slots fill(const Leaf& leaf, const float* from, const Bounds& bounds,
                                                float limit) {
        typename Leaf::Slots near = 0;
        for_each_group_of<groups, any_leaf<Bounds>>(leaf, from, [&](unsigned first, const CornersFromPoint& t) {
            const BoxesFromPoint boxes(t);
            const Floats to_box = bounds.quick(boxes);
            // mutant(never) work: tests triangles whose boxes are too far, with the same result
            if (at_most(to_box, splat(limit)) == 0) return;
            Floats squared_to_sides;
            const Floats bound = larger(bounds.tight(t, boxes, squared_to_sides), to_box);
            store(lower + first, bound);
            store(to_sides + first, squared_to_sides);
            near |= typename Leaf::Slots{at_most(bound, splat(limit))} << first;
        });
        return near & leaf.used_slots();
    }
};

/// Calls `decide(slot)` for the triangles of a leaf that may be within the answer's limit, which the calls may lower;
/// the one with the nearest side comes first, since it lowers it most.
template <class Leaf, class Bounds, class Decide>
ESPALIER_ALWAYS_INLINE inline Visit decide_nearest_first(const Leaf& leaf, const float* from, const Bounds& bounds,
                                                         const Answer& answer, Decide decide) {
    LeafDistances<Leaf> distances;
    constexpr bool any_leaf = LeafDistances<Leaf>::template any_leaf<Bounds>;
    const unsigned vertex_count = any_leaf ? Leaf::max_vertices : leaf.vertex_count;
    auto near = with_table_groups<Leaf::max_vertices>(
        vertex_count, [&](auto groups) { return distances.template fill<groups>(leaf, from, bounds, answer.limit); });
    if (near == 0) return Visit::next;
    auto first = static_cast<unsigned>(std::countr_zero(near));
    // mutant(- -> right side dropped 1) equivalent: compares the first with itself too
    for (auto others = near & (near - 1); others != 0; others &= others - 1) {
        const auto slot = static_cast<unsigned>(std::countr_zero(others));
        if (distances.to_sides[slot] < distances.to_sides[first]) first = slot;
    }
    if (decide(first) == Visit::stop) return Visit::stop;
    near &= ~(typename Leaf::Slots{1} << first);
    for (; near != 0; near &= near - 1) {
        const auto slot = static_cast<unsigned>(std::countr_zero(near));
        if (distances.lower[slot] <= answer.limit && decide(slot) == Visit::stop) return Visit::stop;
    }
    return Visit::next;
}

/// The squared distance from the point to the triangle's box.
inline float squared_distance_to_box(const RoundedPoint& point, const LatticeTriangle& triangle) {
    float squared = 0.0f;
    for (int k = 0; k < 3; ++k) {
        const Span span = span_of(triangle, k);
        const float below = static_cast<float>(span.low) - point.steps[k];
        const float above = point.steps[k] - static_cast<float>(span.high);
        const float gap = maximum(maximum(below, above), 0.0f);
        squared += gap * gap;
    }
    return squared;
}

/// What of the surface is within the radius, and how far it is.
struct PointShape {
    const RoundedPoint& point;
    const BlobData& blob;

    template <class Node>
    unsigned cull(const Node& node, float limit, float* keys) const {
        return distance_test(node, point, blob, limit, keys);
    }
    template <class Node>
    [[nodiscard]] float farthest(const Node& node, unsigned child) const {
        return farthest_squared(node, blob.bits, child, point);
    }
    /// Called, not inlined: its variables take no stack of the walk's.
    template <class Leaf>
    ESPALIER_NOINLINE Visit scan(const Leaf& leaf, Answer& answer) const {
        return decide_nearest_first(leaf, point.steps, PointBounds{}, answer,
                                    [&](unsigned slot) { return offer(leaf, slot, leaf.triangle(slot), answer); });
    }
    template <class Leaf>
    Visit decide(const Leaf& leaf, unsigned slot, const LatticeTriangle& triangle, Answer& answer) const {
        if (squared_distance_to_box(point, triangle) > answer.limit) return Visit::next;
        return offer(leaf, slot, triangle, answer);
    }

protected:
    template <class Leaf>
    Visit offer(const Leaf& leaf, unsigned slot, const LatticeTriangle& triangle, Answer& answer) const {
        const PointDistance distance = distance_to(point, triangle);
        // mutant(without 1) work: offers a triangle that is farther than all that matter, which is not taken
        if (distance.squared > answer.worst || !is_within_radius(point, distance, point.radius)) return Visit::next;
        return hand_over(answer, distance, found_at(leaf, storage_index(leaf, slot)), triangle);
    }
    /// Apart, and assigned one by one: what is found needs no stack below the kernels, and lists are zeroed first.
    ESPALIER_NOINLINE static Visit hand_over(Answer& answer, const PointDistance& distance, const Found& reference,
                                             const LatticeTriangle& triangle) {
        FoundNearest found;
        static_cast<Found&>(found) = reference;
        found.distance = distance;
        found.triangle = triangle;
        return answer.take(found);
    }
};

/// The shape for small cores with a float unit, where a bound costs less than a decision: it visits triangles in the
/// order of their bounds, not in that of the leaf.
struct BoundedPointShape : PointShape {
    std::int32_t below[3];  ///< the point's coordinates, rounded down
    float reach;

    BoundedPointShape(const RoundedPoint& from, const BlobData& of)
        : PointShape{from, of}, reach(reach_from(of, from.steps)) {
        for (int k = 0; k < 3; ++k) below[k] = clamp_to_bounds(from.origin[k] >> from.fraction_bits);
    }
    /// Returns the squared distance of the triangle's box, which may be nearer by less than a step along each axis.
    [[nodiscard]] float bound(const LatticeTriangle& triangle, float limit) const {
        const auto& [a, b, c] = triangle.corner;
        float squared = 0.0f;
        // mutant(< -> <=) sanitizer: reads a fourth coordinate behind three
        for (int k = 0; k < 3 && squared <= limit; ++k) {
            const std::int32_t at = below[k];
            std::int32_t gap = 0;
            if (a[k] > at) gap = (a[k] < b[k] ? (a[k] < c[k] ? a[k] : c[k]) : (b[k] < c[k] ? b[k] : c[k])) - 1 - at;
            else gap = at - (a[k] > b[k] ? (a[k] > c[k] ? a[k] : c[k]) : (b[k] > c[k] ? b[k] : c[k]));
            if (gap > 0) squared += static_cast<float>(gap) * static_cast<float>(gap);
        }
        return squared;
    }
    [[nodiscard]] float tighten(const LatticeTriangle& triangle, float bound, float) const {
        return maximum(squared_gap_to_point(triangle, point.steps, reach), bound);
    }
    template <class Leaf>
    Visit decide(const Leaf& leaf, unsigned slot, const LatticeTriangle& triangle, float, Answer& answer) const {
        return offer(leaf, slot, triangle, answer);
    }
};

ESPALIER_QUERY_OF_SET bool find_overlaps(const BlobData& blob, const RoundedPoint& sphere, Each& answer,
                                         const WalkAccuracy& accuracy) {
    answer.limit = sphere.limit;
    if constexpr (small_code) {  // one query for every answer by distance
        PointShape shape = {sphere, blob};
        return find_each<Answer>(blob, shape, answer, accuracy);
    } else {
        SphereShape shape = {sphere, blob};
        return find_each<Each>(blob, shape, answer, accuracy);
    }
}

ESPALIER_QUERY_OF_SET void find_nearest(const BlobData& blob, const RoundedPoint& point, Answer& answer,
                                        const WalkAccuracy& accuracy) {
    answer.limit = point.limit;
    if constexpr (small_code && has_square_root) {
        BoundedPointShape shape(point, blob);
        find_nearest_first(blob, shape, answer, accuracy);
    } else {
        PointShape shape = {point, blob};
        find_nearest_first(blob, shape, answer, accuracy);
    }
}

ESPALIER_END_SET

#endif
