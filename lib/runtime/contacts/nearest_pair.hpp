// The nearest points of a shape with flat sides and a triangle, in floats that are counted from the shape's middle:
// what the kernels of boxes and hulls share.
#pragma once

#include <runtime/base/bits.hpp>
#include <runtime/contacts/touch.hpp>
#include <runtime/kernels/segment_triangle.hpp>

namespace espalier::detail::contacts {

/// A triangle as a shape has it before it, in lattice steps.
struct SeenTriangle {
    Vec3 corner[3];    ///< from the shape's middle
    Integer3 side[3];  ///< from each corner to the next
    Vec3 along[3];     ///< the same in float: small cores take long to convert it
    Vec3 face;         ///< the unit normal, zero without area
    Vec3 front;        ///< the same, but without area any direction across
    unsigned longest;  ///< the number of the longest side

    ESPALIER_NOINLINE SeenTriangle(const LatticeTriangle& triangle, const Integer3& middle, int fraction_bits)
        : face(face_normal_of(triangle)), front(front_of(triangle)), longest(0) {
        float most = -1.0f;
        for (int i = 0; i < 3; ++i) {
            corner[i] = to_vector(corner_on_grid(triangle, i, fraction_bits) - middle) * power_of_two(-fraction_bits);
            side[i] = side_from(triangle, i);
            along[i] = to_vector(side[i]);
            const float length = dot(along[i], along[i]);
            if (length <= most) continue;
            most = length;
            longest = static_cast<unsigned>(i);
        }
    }
    /// Whether a point is over the face, on either side. Also between the ends of the longest side: far beyond the tip
    /// of a needle a point is still on the inner side of all three, but for rounding.
    [[nodiscard]] bool is_over_face(const Vec3& p) const {
        for (unsigned i = 0; i < 3; ++i)
            if (!(dot(cross(along[i], p - corner[i]), front) > 0.0f)) return false;
        const float at = dot(p - corner[longest], along[longest]);
        return at >= 0.0f && at <= dot(along[longest], along[longest]);
    }
    [[nodiscard]] float reach() const {
        return maximum(maximum(largest(corner[0]), largest(corner[1])), largest(corner[2]));
    }
};

/// How far a shape is from a triangle along one direction, which leads from the triangle to the shape: of all
/// directions that separate them, each bounds by how much the shape can go back until it touches, and until it is
/// through. Both are below 0 where it has to come forward.
struct GapAlong {
    Vec3 way;
    float to_touch = -infinity;
    float to_leave = infinity;

    [[nodiscard]] bool rules_out(float) const { return false; }
    void offer(const Vec3& normal, float gap) {
        const float share = dot(normal, way);
        if (share > 0.0f) to_touch = maximum(to_touch, gap / share);
        else if (share < 0.0f) to_leave = minimum(to_leave, gap / share);
        else if (gap > 0.0f) to_leave = -infinity;
    }
    [[nodiscard]] bool is_over() const { return to_touch <= to_leave && to_leave >= 0.0f; }
};

/// The nearest points of shape and triangle.
struct NearestPair {
    float squared = infinity;
    Vec3 apart;  ///< from the triangle to the shape
    Vec3 on_triangle;
    Feature feature = Feature::face;

    void offer(const Vec3& on_shape, const Vec3& place, Feature part) {
        const Vec3 between = on_shape - place;
        const float length = dot(between, between);
        if (length < squared) *this = {length, between, place, part};
    }
};

/// Returns the direction from the triangle to the shape: that of the axis, which has less rounding than that between
/// two points, where they agree or are hardly apart. `size` is what both reach from the shape's middle.
inline Vec3 direction_between(const NearestPair& nearest, const Separation& separation, float distance, float size) {
    const Vec3 off_axis = nearest.apart - separation.normal * distance;
    const bool is_of_axis = distance <= size * 0x1p-19f || largest(off_axis) < size * 0x1p-19f;
    return is_of_axis ? separation.normal : direction_of(nearest.apart);
}

/// The first place of a shape with flat sides.
struct FirstPlace {
    NearestPair nearest;
    Vec3 normal;
    float distance;
    float size;  ///< what both reach from the shape's middle
    bool is_deep;

    /// `find_nearest` finds the nearest points after a move.
    template <class FindNearest>
    FirstPlace(const Separation& separation, float both_reach, FindNearest find_nearest) : size(both_reach) {
        // Which directions are tried decides only whether the two meet. Beyond the tip of a shape that is flat or thin
        // they separate by no more than rounding, and only the distance can say that it is apart there.
        const bool is_in_doubt = separation.gap > size * -0x1p-20f;
        nearest = find_nearest(is_in_doubt ? Vec3{} : separation.normal * -separation.gap);
        const float rounding = size * 0x1p-19f;
        is_deep = separation.gap < 0.0f && (!is_in_doubt || nearest.squared <= rounding * rounding);
        distance = is_deep ? separation.gap : square_root(nearest.squared);
        normal = direction_between(nearest, separation, distance, size);
    }

    /// Gives it the normal of the facing side, if it is on an internal feature or leads the shape's middle through the
    /// triangle. `find_gap` offers all directions that may separate, and `find_nearest` finds the nearest points after
    /// a move. Returns false where no part of the shape is over the triangle.
    template <class FindGap, class FindNearest>
    bool turn(const SeenTriangle& seen, const FacingSide& side, FindGap find_gap, FindNearest find_nearest) {
        const bool is_touching = is_deep || distance <= size * 0x1p-19f;
        const bool leads_through = is_touching && dot(normal, nearest.on_triangle) > size * 0x1p-20f;
        if (!(largest(seen.face) > 0.0f) || (!leads_through && side.keeps(nearest.feature, normal, seen.face)))
            return true;
        const Vec3 to_middle = nearest.on_triangle * -1.0f;
        bool is_back = false, is_turned = false;
        const bool is_open = !side.finds_side(nearest.feature, seen.face, is_back);
        if (is_open) {
            GapAlong through = {seen.face};  // the side on which most of the shape is that is over the triangle
            find_gap(through);
            is_back = -through.to_touch > through.to_leave;
        }
        GapAlong along = {outward_from(seen.face, is_back, to_middle, size * 0x1p-20f, is_turned)};
        if (is_open && side.is_bent(along.way, seen.face)) {
            along.way = side.own_normal(seen.face);
            is_turned = false;
        }
        find_gap(along);
        if (!is_deep && !leads_through && !along.is_over()) return false;
        normal = along.way;
        if (!is_deep) return true;
        distance = minimum(distance, along.to_touch);
        if (!is_turned) nearest = find_nearest(normal * -distance);
        return true;
    }
};

inline float clamped_share(float part, float whole) {
    return part <= 0.0f ? 0.0f : part >= whole ? 1.0f : part / whole;
}

/// Returns the point of a side nearest to p and the part of the triangle that it lies on.
inline Vec3 nearest_on_side(const SeenTriangle& seen, unsigned side, const Vec3& p, Feature& feature) {
    const unsigned next = side == 2 ? 0 : side + 1;
    const Vec3& start = seen.corner[side];
    const Vec3 along = seen.corner[next] - start;
    const float share = clamped_share(dot(p - start, along), dot(along, along));
    feature = share == 0.0f   ? vertex_of(static_cast<int>(side))
              : share == 1.0f ? vertex_of(static_cast<int>(next))
                              : edge_of(static_cast<int>(side));
    return start + along * share;
}

/// Offers the pair of a vertex of the shape and the triangle: within its face or on a side.
inline void try_vertex(const Vec3& p, const SeenTriangle& seen, NearestPair& nearest) {
    if (seen.is_over_face(p)) {
        nearest.offer(p, p - seen.front * dot(seen.front, p - seen.corner[0]), Feature::face);
        return;
    }
    for (unsigned i = 0; i < 3; ++i) {
        Feature feature = Feature::face;
        const Vec3 place = nearest_on_side(seen, i, p, feature);
        nearest.offer(p, place, feature);
    }
}

/// Offers the nearest points of an edge of the shape and a side of the triangle, ends included. `across` is the product
/// of edge and side, from exact integers: of edges that are nearly parallel floats would leave only rounding.
inline void try_edge(const Vec3& from, const Vec3& along, const Vec3& across, const SeenTriangle& seen, unsigned side,
                     NearestPair& nearest) {
    const Vec3 &d = seen.along[side], between = seen.corner[side] - from;
    const float whole = dot(across, across);
    float share = whole > 0.0f ? clamped_share(dot(cross(between, d), across), whole) : 0.0f;
    Feature feature = Feature::face;
    const Vec3 place = nearest_on_side(seen, side, from + along * share, feature);
    share = clamped_share(dot(place - from, along), dot(along, along));
    nearest.offer(from + along * share, place, feature);
}

}  // namespace espalier::detail::contacts
