// Closest points to segments and boxes, and overlaps of capsules: bounds of nodes and triangles in lanes (small cores
// have others), and the queries. What they leave open is decided by segment_triangle.hpp and triangle_distance.hpp.
#ifndef ESPALIER_PROXIMITY_PAIR_SEARCH_HPP
#define ESPALIER_PROXIMITY_PAIR_SEARCH_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/proximity/queries.hpp>
#include <runtime/proximity/point_search.hpp>

ESPALIER_BEGIN_SET

/// A bound on the squared distance of a shape from boxes: of the gaps along the axes and, of a segment, along the
/// directions across it and one axis: of the separating axes of boxes and segments (Gottschalk, Lin and Manocha 1996),
/// the only ones.
ESPALIER_SHARED_OR_PART_OF_CALLER inline Floats bound_of_boxes(const DistantShape& shape, const Floats* low,
                                                               const Floats* high, float limit) {
    const float* const from = shape.segment.from_steps;
    Floats bound = splat(0.0f);
    for (int k = 0; k < 3; ++k) {
        const Floats below = subtract(low[k], splat(shape.highest[k])),
                     above = subtract(splat(shape.lowest[k]), high[k]);
        const Floats gap = larger(larger(below, above), splat(0.0f));
        bound = add(multiply(gap, gap), bound);
    }
    if (shape.is_box || at_most(bound, splat(limit)) == 0) return bound;
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
        const Floats slack = multiply(add(multiply(length_y, reach[y]), multiply(length_z, reach[z])), splat(0x1p-19f));
        const Floats gap = multiply(larger(subtract(subtract(apart, covered), slack), splat(0.0f)), splat(0.5f));
        bound = larger(multiply(gap, gap), bound);
    }
    return bound;
}

#if ESPALIER_LANES == 16

using avx2::pair_test;  // as in point_nodes.hpp

#else

/// The children of a node whose box is within the limit of the shape, and a bound on the squared distance of each.
template <class Node>
inline unsigned pair_test(const Node& node, const DistantShape& shape, const BlobData& blob, float limit,
                          float* distances) {
    const auto boxes = boxes_of(node, blob);
    unsigned mask = 0;
    const unsigned end = small_code ? node.node_children() + node.leaf_children() : Node::max_children;
    for (unsigned first = 0; first < end; first += lanes) {
        Floats low[3], high[3];
        for (int k = 0; k < 3; ++k) {
            low[k] = boxes.low(k, first);
            high[k] = boxes.high(k, first);
        }
        const Floats bound = bound_of_boxes(shape, low, high, limit);
        mask |= at_most(bound, splat(limit)) << first;
        store(distances + first, bound);
    }
    return mask & all_children(node);
}

#endif

#if ESPALIER_SMALL_CODE

/// Between the plane of a triangle and all that is between two points; of a box its corners farthest apart across the
/// plane. Squared; 0 where that is not clear.
inline float squared_gap_to_plane(const DistantShape& shape, const LatticeTriangle& triangle) {
    const float* from = shape.segment.from_steps;
    const float* to = shape.segment.to_steps;
    const auto& c = triangle.corner;
    const auto edge = [&](int end, int k) { return static_cast<float>(c[end][k] - c[0][k]); };
    float from_side = 0.0f, to_side = 0.0f, slack = 0.0f, squared_length = 0.0f;
    for (int k = 0; k < 3; ++k) {
        const int y = k == 2 ? 0 : k + 1, z = k == 0 ? 2 : k - 1;
        const float plus = edge(1, y) * edge(2, z), minus = edge(1, z) * edge(2, y);
        const float normal = plus - minus, size = absolute(plus) + absolute(minus);
        const bool backward = shape.is_box && normal < 0.0f;
        const float corner = static_cast<float>(c[0][k]);
        const float to_from = (backward ? to : from)[k] - corner, to_to = (backward ? from : to)[k] - corner;
        from_side += normal * to_from;
        to_side += normal * to_to;
        slack += size * (absolute(to_from) + absolute(to_to));
        const float length = absolute(normal) + size * 0x1p-22f;
        squared_length += length * length;
    }
    if ((from_side < 0.0f) != (to_side < 0.0f)) return 0.0f;
    const float nearer = minimum(absolute(from_side), absolute(to_side)) - slack * 0x1p-20f;
    if (!(nearer > 0.0f)) return 0.0f;
    const float gap = nearer / square_root(squared_length);
    return gap * gap;
}

/// The same for small cores: triangles in the order of their bounds, one by one.
struct PairShape {
    const DistantShape& shape;
    const BlobData& blob;
    float reach;

    template <class Node>
    unsigned cull(const Node& node, float limit, float* keys) const {
        return pair_test(node, shape, blob, limit, keys);
    }
    [[nodiscard]] float bound(const LatticeTriangle& triangle, float limit) const {
        Floats low[3], high[3];
        for (int k = 0; k < 3; ++k) {
            const Span span = span_of(triangle, k);
            low[k] = static_cast<float>(span.low);
            high[k] = static_cast<float>(span.high);
        }
        return bound_of_boxes(shape, low, high, limit);
    }
    [[nodiscard]] float tighten(const LatticeTriangle& triangle, float bound, float limit) const {
        bound = maximum(squared_gap_to_plane(shape, triangle), bound);
        return shape.is_box || bound > limit
                   ? bound
                   : maximum(squared_gap_to_segment(triangle, shape.segment.from_steps, shape.segment.to_steps, reach),
                             bound);
    }
    template <class Leaf>
    Visit decide(const Leaf& leaf, unsigned slot, const LatticeTriangle& triangle, float, Answer& answer) const {
        FoundPair found;
        static_cast<Found&>(found) = found_at(leaf, storage_index(leaf, slot));
        return shape.decide(triangle, found, answer);
    }
};

/// What of the surface is within the radius of a segment, in storage order.
struct CapsuleShape {
    PairShape pair;

    template <class Node>
    unsigned cull(const Node& node, float limit, float* keys) const {
        return pair.cull(node, limit, keys);
    }
    template <class Leaf>
    Visit decide(const Leaf& leaf, unsigned slot, const LatticeTriangle& triangle, Each& answer) const {
        const float bound = pair.bound(triangle, answer.limit);
        if (bound > answer.limit || pair.tighten(triangle, bound, answer.limit) > answer.limit) return Visit::next;
        count_decision();
        const DistantShape& shape = pair.shape;
        if (!is_within_radius(shape.segment, triangle, distance_to(shape.segment, triangle), shape.radius))
            return Visit::next;
        return answer.take(found_at(leaf, storage_index(leaf, slot)), leaf, slot);
    }
};

#else

/// Bounds on the squared distances of triangles, seen from the start of the segment or the lowest corner of the box.
class PairBounds {
public:
    static constexpr bool is_costly = true;

    /// `reach` is at least the sum of the absolute coordinates of any point of the asset and of the shape, from there.
    PairBounds(const DistantShape& shape, float reach) : reach_(splat(reach)), is_box_(shape.is_box) {
        const float* const from = shape.segment.from_steps;
        const float* const to = shape.segment.to_steps;
        way_ = {splat(to[0] - from[0]), splat(to[1] - from[1]), splat(to[2] - from[2])};
        squared_way_ = dot(way_, way_);
    }

    [[nodiscard]] Floats quick(const BoxesFromPoint& boxes) const {
        const Floats way[3] = {way_.x, way_.y, way_.z}, slack = multiply(reach_, splat(0x1p-22f));
        Floats squared = splat(0.0f);
        for (int k = 0; k < 3; ++k) {
            const Floats below = subtract(boxes.low[k], larger(way[k], splat(0.0f)));
            const Floats above = subtract(smaller(way[k], splat(0.0f)), boxes.high[k]);
            const Floats gap = larger(subtract(larger(below, above), slack), splat(0.0f));
            squared = add(multiply(gap, gap), squared);
        }
        return squared;
    }

    /// `nearest` is about the squared distance of the sides alone.
    [[nodiscard]] Floats tight(const CornersFromPoint& t, const BoxesFromPoint&, Floats& nearest) const {
        const Floats3 normal = cross(subtract(t.b, t.a), subtract(t.c, t.a));
        const Floats3 between = is_box_ ? between_box(t, nearest) : between_segment(t, nearest);
        return larger(along(normal, t), along(between, t));
    }

    /// Returns the triangles whose face is surely within the radius of a segment: the point of the segment that is
    /// nearest to the plane is over the face, and no farther (docs/numerics.md, *Capsules in lanes*).
    [[nodiscard]] unsigned within_over_face(const CornersFromPoint& t, Floats reach, float radius) const {
        const Floats3 ab = subtract(t.b, t.a), ac = subtract(t.c, t.a), normal = cross(ab, ac);
        const Floats share = smaller(larger(divide(dot(normal, t.a), dot(normal, way_)), splat(0.0f)), splat(1.0f));
        const Floats3 place = {multiply(share, way_.x), multiply(share, way_.y), multiply(share, way_.z)};
        const Floats3 a = subtract(t.a, place), b = subtract(t.b, place), c = subtract(t.c, place);
        const Floats least =
            smaller(dot(cross(a, b), normal), smaller(dot(cross(b, c), normal), dot(cross(c, a), normal)));
        // What the normal may be off by, times 2^20; and its own size.
        const Floats doubt = multiply(add(length_bound(ab), length_bound(ac)), reach), size = length_bound(normal);
        const Floats weight = multiply(multiply(multiply(reach, reach), splat(0x1p-18f)), add(size, doubt));
        const Floats rounding = add(multiply(reach, size), multiply(add(reach, splat(radius)), doubt));
        const Floats apart = add(magnitude(dot(normal, a)), multiply(rounding, splat(0x1p-19f)));
        // Finite, so that what overflows is not accepted; and a triangle that is a point has no face.
        const Floats most =
            smaller(multiply(dot(normal, normal), splat(radius * radius * (1.0f - 0x1p-20f))), splat(0x1.fffffep127f));
        return at_most(larger(weight, splat(0x1p-60f)), least) & at_most(multiply(apart, apart), most);
    }
    /// At least the sum of the absolute coordinates of any point of the segment or the box.
    [[nodiscard]] Floats length() const { return length_bound(way_); }

private:
    static Floats share_of(Floats part, Floats whole, float least) {
        return larger(smaller(divide(part, larger(whole, splat(least))), splat(1.0f)), splat(0.0f));
    }

    /// The bound that a direction gives.
    [[nodiscard]] Floats along(const Floats3& direction, const CornersFromPoint& t) const {
        const Floats to_a = dot(direction, t.a), to_b = dot(direction, t.b), to_c = dot(direction, t.c);
        const Floats low = smaller(to_a, smaller(to_b, to_c)), high = larger(to_a, larger(to_b, to_c));
        const Floats x = multiply(direction.x, way_.x), y = multiply(direction.y, way_.y),
                     z = multiply(direction.z, way_.z);
        const Floats zero = splat(0.0f), end = add(add(x, y), z);
        const Floats end_low =
            is_box_ ? add(add(smaller(x, zero), smaller(y, zero)), smaller(z, zero)) : smaller(end, zero);
        const Floats end_high =
            is_box_ ? add(add(larger(x, zero), larger(y, zero)), larger(z, zero)) : larger(end, zero);
        const Floats length_bound = add(magnitude(direction.x), add(magnitude(direction.y), magnitude(direction.z)));
        const Floats rounding = multiply(multiply(length_bound, splat(0x1p-20f)), reach_);
        const Floats gap = larger(subtract(larger(subtract(low, end_high), subtract(end_low, high)), rounding), zero);
        // No squared length of a direction that matters is as small as this.
        return multiply(gap, divide(gap, larger(dot(direction, direction), splat(0x1p-60f))));
    }

    /// From the closest points of the segment and of the triangle's sides (Ericson 2005, 5.1.9).
    [[nodiscard]] Floats3 between_segment(const CornersFromPoint& t, Floats& nearest) const {
        const Floats3* const corner[] = {&t.a, &t.b, &t.c, &t.a};
        Floats3 direction = {splat(0.0f), splat(0.0f), splat(0.0f)};
        nearest = splat(infinity);
        for (int i = 0; i < 3; ++i) {
            const Floats3& start = *corner[i];
            const Floats3 side = subtract(*corner[i + 1], start);
            const Floats squared_side = dot(side, side), both = dot(way_, side);
            const Floats on_way = dot(start, way_), on_side = dot(start, side);
            // Sides are whole steps long, segments whole units of 2^-6 steps.
            Floats on_segment = share_of(multiply_subtract(on_way, squared_side, multiply(on_side, both)),
                                         multiply_subtract(squared_way_, squared_side, multiply(both, both)), 0x1p-24f);
            const Floats on_edge = share_of(multiply_subtract(on_segment, both, on_side), squared_side, 1.0f);
            on_segment = share_of(multiply_add(on_edge, both, on_way), squared_way_, 0x1p-12f);
            offer({gap_of(start.x, side.x, way_.x, on_edge, on_segment),
                   gap_of(start.y, side.y, way_.y, on_edge, on_segment),
                   gap_of(start.z, side.z, way_.z, on_edge, on_segment)},
                  direction, nearest);
        }
        return direction;
    }
    static Floats gap_of(Floats start, Floats side, Floats way, Floats on_edge, Floats on_segment) {
        return subtract(multiply_add(on_edge, side, start), multiply(on_segment, way));
    }

    /// From the place of the box that is nearest to the triangle's middle, to the sides and back.
    [[nodiscard]] Floats3 between_box(const CornersFromPoint& t, Floats& nearest) const {
        const Floats third = splat(1.0f / 3.0f);
        const Floats3 middle = {multiply(add(add(t.a.x, t.b.x), t.c.x), third),
                                multiply(add(add(t.a.y, t.b.y), t.c.y), third),
                                multiply(add(add(t.a.z, t.b.z), t.c.z), third)};
        const Floats3 place = within_box(middle);
        const Floats3 to_side =
            closest_on_sides(subtract(t.a, place), subtract(t.b, place), subtract(t.c, place), nearest);
        const Floats3 on_side = {add(place.x, to_side.x), add(place.y, to_side.y), add(place.z, to_side.z)};
        return subtract(on_side, within_box(on_side));
    }
    [[nodiscard]] Floats3 within_box(const Floats3& p) const {
        const auto within = [](Floats at, Floats end) { return larger(smaller(at, end), splat(0.0f)); };
        return {within(p.x, way_.x), within(p.y, way_.y), within(p.z, way_.z)};
    }
    Floats3 way_;
    Floats squared_way_;
    Floats reach_;
    bool is_box_;
};

/// What of the surface is within the radius of a segment or a box, and how far it is.
struct PairShape {
    struct CostlyLeaves {};
    const DistantShape& shape;
    const BlobData& blob;
    PairBounds bounds;

    template <class Node>
    unsigned cull(const Node& node, float limit, float* keys) const {
        return pair_test(node, shape, blob, limit, keys);
    }
    template <class Leaf>
    ESPALIER_NOINLINE Visit scan(const Leaf& leaf, Answer& answer) const {
        return decide_nearest_first(leaf, shape.segment.from_steps, bounds, answer, [&](unsigned slot) {
            FoundPair found;
            static_cast<Found&>(found) = found_at(leaf, storage_index(leaf, slot));
            return shape.decide(leaf.triangle(slot), found, answer);
        });
    }
};

/// What of the surface is within the radius of a segment, by whichever points.
struct CapsuleShape {
    const DistantShape& shape;
    const BlobData& blob;
    PairBounds bounds;

    CapsuleShape(const DistantShape& of, const BlobData& in, float reach) : shape(of), blob(in), bounds(of, reach) {}
    template <class Node>
    unsigned cull(const Node& node, float limit, float* keys) const {
        return pair_test(node, shape, blob, limit, keys);
    }
    template <class Leaf>
    Visit scan(const Leaf& leaf, Each& answer) const {
        const auto candidates = with_table_groups<Leaf::max_vertices>(
            leaf.vertex_count, [&](auto groups) { return candidates_of<groups>(leaf, answer.limit); });
        return take_candidates(leaf, candidates, answer, [&](unsigned slot) {
            count_decision();
            const LatticeTriangle triangle = leaf.triangle(slot);
            return is_within_radius(shape.segment, triangle, distance_to(shape.segment, triangle), shape.radius);
        });
    }

private:
    template <unsigned groups, class Leaf>
    ESPALIER_NOINLINE OverlapCandidates<typename Leaf::Slots> candidates_of(const Leaf& leaf, float limit) const {
        using Slots = typename Leaf::Slots;
        OverlapCandidates<Slots> candidates;
        for_each_group_of<groups>(leaf, shape.segment.from_steps, [&](unsigned first, const CornersFromPoint& t) {
            const BoxesFromPoint boxes(t);
            const Floats to_box = bounds.quick(boxes);
            if (at_most(to_box, splat(limit)) == 0) return;
            Floats to_sides;
            const Floats bound = larger(bounds.tight(t, boxes, to_sides), to_box);
            const unsigned near = at_most(bound, splat(limit));
            // The two points that are compared are off by less than half of what is subtracted.
            const Floats reach = add(boxes.reach(), bounds.length());
            const Floats inner = larger(subtract(splat(shape.radius), multiply(reach, splat(0x1p-19f))), splat(0.0f));
            const Floats inner_limit = multiply(multiply(inner, inner), splat(1.0f - 0x1p-20f));
            unsigned inside = at_most(to_sides, subtract(inner_limit, splat(0x1p-60f)));
            if ((near & ~inside) != 0) inside |= bounds.within_over_face(t, reach, shape.radius);
            candidates.near |= Slots{near} << first;
            candidates.sure |= Slots{inside} << first;
        });
        candidates.near &= leaf.used_slots();
        return candidates;
    }
};

#endif

/// Returns at least the sum of the absolute coordinates of any point of the asset and of the shape, seen from its
/// start.
inline float reach_of(const BlobData& blob, const DistantShape& shape) {
    float reach = reach_from(blob, shape.segment.from_steps);
    if constexpr (!small_code)
        for (int k = 0; k < 3; ++k) reach += shape.highest[k] - shape.lowest[k];
    return reach;
}

ESPALIER_QUERY_OF_SET void find_nearest_pair(const BlobData& blob, const DistantShape& shape, Answer& answer) {
    answer.limit = squared_limit_of(shape);
#if ESPALIER_SMALL_CODE
    PairShape pair = {shape, blob, reach_of(blob, shape)};
#else
    PairShape pair = {shape, blob, PairBounds(shape, reach_of(blob, shape))};
#endif
    find_nearest_first(blob, pair, answer);
}

ESPALIER_QUERY_OF_SET bool find_overlaps_of_capsule(const BlobData& blob, const DistantShape& shape, Each& answer,
                                                    const WalkAccuracy& accuracy) {
    answer.limit = squared_limit_of(shape);
#if ESPALIER_SMALL_CODE
    CapsuleShape capsule = {{shape, blob, reach_of(blob, shape)}};
#else
    CapsuleShape capsule(shape, blob, reach_of(blob, shape));
#endif
    return find_each<Each>(blob, capsule, answer, accuracy);
}

ESPALIER_END_SET

#endif
