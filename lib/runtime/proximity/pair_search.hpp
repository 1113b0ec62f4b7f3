// Closest points to segments and boxes: bounds of nodes and triangles in lanes, and the query. Bounds only ever reject
// (closest_pair.cpp has them without lanes); what they leave open is decided by segment_triangle.hpp and
// triangle_distance.hpp.
#ifndef ESPALIER_PROXIMITY_PAIR_SEARCH_HPP
#define ESPALIER_PROXIMITY_PAIR_SEARCH_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/proximity/closest_pair.hpp>
#include <runtime/proximity/pair_nodes.hpp>
#include <runtime/proximity/point_search.hpp>

ESPALIER_BEGIN_SET

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

private:
    static Floats3 cross(const Floats3& a, const Floats3& b) {
        return {multiply_subtract(a.y, b.z, multiply(a.z, b.y)), multiply_subtract(a.z, b.x, multiply(a.x, b.z)),
                multiply_subtract(a.x, b.y, multiply(a.y, b.x))};
    }
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
        const Floats3 a = subtract(t.a, place), b = subtract(t.b, place), c = subtract(t.c, place);
        Floats3 to_side = {splat(0.0f), splat(0.0f), splat(0.0f)};
        nearest = splat(infinity);
        offer(closest_on_side(a, b), to_side, nearest);
        offer(closest_on_side(b, c), to_side, nearest);
        offer(closest_on_side(c, a), to_side, nearest);
        const Floats3 on_side = {add(place.x, to_side.x), add(place.y, to_side.y), add(place.z, to_side.z)};
        return subtract(on_side, within_box(on_side));
    }
    [[nodiscard]] Floats3 within_box(const Floats3& p) const {
        const auto within = [](Floats at, Floats end) { return larger(smaller(at, end), splat(0.0f)); };
        return {within(p.x, way_.x), within(p.y, way_.y), within(p.z, way_.z)};
    }
    static void offer(const Floats3& other, Floats3& closest, Floats& squared) {
        const Floats other_squared = dot(other, other);
        closest = {where_at_most(other_squared, squared, other.x, closest.x),
                   where_at_most(other_squared, squared, other.y, closest.y),
                   where_at_most(other_squared, squared, other.z, closest.z)};
        squared = smaller(other_squared, squared);
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

ESPALIER_QUERY_OF_SET void find_nearest_pair(const BlobData& blob, const DistantShape& shape, float reach,
                                             Answer& answer) {
    PairShape pair = {shape, blob, PairBounds(shape, reach)};
    find_nearest_first(blob, pair, answer);
}

ESPALIER_END_SET

#endif
