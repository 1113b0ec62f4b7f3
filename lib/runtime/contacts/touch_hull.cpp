// Contacts of convex hulls, in floats that are counted from a point within: faces and pairs of edges for the depth, as
// far as edges can make a face of the Minkowski difference (Gregorius, The separating axis test between convex
// polyhedra, GDC 2013), and pairs of features for the distance. Directions come from exact integers.
#include <runtime/contacts/hull_body.hpp>
#include <runtime/contacts/nearest_pair.hpp>

namespace espalier::detail::contacts {

namespace {

/// A triangle beside a hull.
struct TriangleBeside : SeenTriangle {
    float size;  ///< what it and the hull reach from the hull's middle

    TriangleBeside(const HullBody& hull, const LatticeTriangle& triangle)
        : SeenTriangle(triangle, hull.middle, hull.fraction_bits), size(hull.size + reach()) {}
    [[nodiscard]] float lowest(const Vec3& way) const {
        return minimum(minimum(dot(way, corner[0]), dot(way, corner[1])), dot(way, corner[2]));
    }
};

/// An edge of a hull, from a corner with a lower number to one with a higher.
struct HullEdge {
    unsigned from;
    unsigned beside;  ///< the corners behind it in its two faces
    unsigned across;
    Integer3 units;
};
template <class Function>
void for_each_edge(const HullBody& hull, Function function) {
    for (unsigned face = 0; face < hull.face_count; ++face) {
        for (unsigned i = hull.first[face]; i < hull.first[face + 1u]; ++i) {
            const unsigned end = hull.next(face, i), a = hull.from[i], b = hull.from[end];
            if (a < b)
                function(
                    HullEdge{a, hull.from[hull.next(face, end)], hull.across[i], hull.units_at(b) - hull.units_at(a)});
        }
    }
}

/// Offers the directions that may separate to a Separation or a GapAlong.
template <class Best>
class Separating {
public:
    ESPALIER_NOINLINE Separating(const HullBody& hull, const TriangleBeside& triangle, Best& best)
        : hull_(hull), triangle_(triangle), best_(best) {
        for (const float sense : {1.0f, -1.0f}) try_way(triangle.front * sense);
        for (unsigned face = 0; face < hull.face_count; ++face) try_face(face);
        const bool is_flat = hull.face_count <= 2;
        for_each_edge(hull, [&](const HullEdge& edge) {
            for (unsigned side = 0; side < 3; ++side) try_edges(edge, side);
            // A triangle that is a point has no sides, so that no product of it and a segment gives a direction.
            static constexpr Integer3 units[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
            if (hull.vertex_count == 2)
                for (const Integer3& unit : units) try_both_ways(to_vector(cross(edge.units, unit)));
            // Within the triangle's plane, in which a flat hull may lie beside it.
            if (is_flat) try_both_ways(cross(triangle.front, to_vector(edge.units)));
        });
        if (!is_flat) return;
        for (const Vec3& side : triangle.along) try_both_ways(cross(triangle.front, side));
    }

private:
    /// Tries a unit vector that leads from the hull to the triangle.
    void try_way(const Vec3& way) {
        const float low = triangle_.lowest(way);
        float high = -infinity;
        for (unsigned i = 0; i < hull_.vertex_count; ++i) {
            high = maximum(high, dot(way, hull_.at(i)));
            if (best_.rules_out(low - high)) return;
        }
        best_.offer(way * -1.0f, low - high);
    }
    void try_face(unsigned face) {
        const Vec3 way = direction_of(hull_.normal_of_face(face));
        if (!(dot(way, way) > 0.0f)) return;
        const float gap = triangle_.lowest(way) - dot(way, hull_.at(hull_.from[hull_.first[face]]));
        if (!best_.rules_out(gap)) try_way(way);
    }
    /// Tries both directions across an edge of the hull and a side.
    void try_edges(const HullEdge& edge, unsigned side) {
        const Integer3 axis = cross(edge.units, triangle_.side[side]);
        if (is_zero(axis)) return;
        const Vec3 scaled = to_vector(axis);
        const Vec3 from = hull_.at(edge.from);
        // Only where each has the rest behind it, but for rounding.
        const float at_first = dot(scaled, hull_.at(edge.beside) - from),
                    at_second = dot(scaled, hull_.at(edge.across) - from);
        const float at_third = dot(scaled, triangle_.corner[side == 0 ? 2 : side - 1] - triangle_.corner[side]);
        const float slack = largest(scaled) * triangle_.size * 0x1p-20f;
        const float highest = maximum(at_first, at_second), lowest = minimum(at_first, at_second);
        const bool goes_up = highest <= slack && at_third >= -slack, goes_down = lowest >= -slack && at_third <= slack;
        if (!goes_up && !goes_down) return;
        const Vec3 way = direction_of(scaled);
        const float gap = dot(way, triangle_.corner[side] - from);
        if (goes_up && !best_.rules_out(gap)) try_way(way);
        if (goes_down && !best_.rules_out(-gap)) try_way(way * -1.0f);
    }

    /// Tries both senses of an axis of any length.
    void try_both_ways(const Vec3& axis) {
        const Vec3 way = direction_of(axis);
        if (!(dot(way, way) > 0.0f)) return;
        try_way(way);
        try_way(way * -1.0f);
    }

    const HullBody& hull_;
    const TriangleBeside& triangle_;
    Best& best_;
};

/// Whether a point is over a face of the hull, or under it, along a direction that leads from there to the outside.
/// Differences of corners are exact: corners that are close to each other and far from the middle are alike in float,
/// and any point would be over a face between them.
bool is_over(const HullBody& hull, unsigned face, const Vec3& way, const Vec3& point) {
    const auto between = [&](unsigned a, unsigned b) {
        const std::int32_t *start = hull.vertex[a], *end = hull.vertex[b];
        return Vec3{static_cast<float>(end[0] - start[0]), static_cast<float>(end[1] - start[1]),
                    static_cast<float>(end[2] - start[2])} *
               hull.scale;
    };
    Vec3 longest;
    float most = 0.0f;
    const unsigned start = hull.from[hull.first[face]];
    for (unsigned i = hull.first[face]; i < hull.first[face + 1u]; ++i) {
        const unsigned from = hull.from[i];
        if (dot(cross(between(from, hull.from[hull.next(face, i)]), point - hull.at(from)), way) < 0.0f) return false;
        const Vec3 reach = between(start, from);
        const float length = dot(reach, reach);
        if (length <= most) continue;
        most = length;
        longest = reach - way * dot(way, reach);
    }
    // At a sharp corner the edges alone leave much room for rounding.
    float low = 0.0f, high = 0.0f;
    for (unsigned i = hull.first[face]; i < hull.first[face + 1u]; ++i) {
        const float at = dot(longest, between(start, hull.from[i]));
        low = minimum(low, at);
        high = maximum(high, at);
    }
    const float at = dot(longest, point - hull.at(start));
    return low <= at && at <= high;
}

/// Offers the pairs of a face and the corners of the triangle that are over it.
void try_corners(const HullBody& hull, unsigned face, const Vec3& moved, const TriangleBeside& triangle,
                 NearestPair& nearest) {
    const Vec3 normal = direction_of(hull.normal_of_face(face));
    if (!(dot(normal, normal) > 0.0f)) return;
    for (int i = 0; i < 3; ++i) {
        const Vec3& corner = triangle.corner[i];
        const Vec3 point = corner - moved;
        const float above = dot(normal, point - hull.at(hull.from[hull.first[face]]));
        if (above < triangle.size * -0x1p-18f || above * above > nearest.squared) continue;
        if (is_over(hull, face, normal, point)) nearest.offer(corner - normal * above, corner, vertex_of(i));
    }
}

/// Returns the nearest points of the hull, moved by that much, and the triangle; they share no inner point.
NearestPair nearest_pair(const HullBody& hull, const Vec3& moved, const TriangleBeside& triangle) {
    NearestPair nearest;
    for (unsigned i = 0; i < hull.vertex_count; ++i) try_vertex(hull.at(i) + moved, triangle, nearest);
    for (unsigned face = 0; face < hull.face_count; ++face) try_corners(hull, face, moved, triangle, nearest);
    for_each_edge(hull, [&](const HullEdge& edge) {
        const Vec3 from = hull.at(edge.from) + moved, along = to_vector(edge.units) * hull.scale;
        for (unsigned side = 0; side < 3; ++side) {
            const Vec3 across = to_vector(cross(edge.units, triangle.side[side])) * hull.scale;
            try_edge(from, along, across, triangle, side, nearest);
        }
    });
    return nearest;
}

/// The places on the triangle that reach farthest in eight directions.
class FarthestPlaces {
public:
    explicit FarthestPlaces(const Vec3& normal) {
        const int k = shortest_axis(Vec3{absolute(normal.x), absolute(normal.y), absolute(normal.z)});
        const Vec3 axis = {k == 0 ? 1.0f : 0.0f, k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f};
        const Vec3 u = direction_of(cross(normal, axis)), v = cross(normal, u);
        const Vec3 ways[most / 2] = {u, v, u + v, u - v};
        for (unsigned i = 0; i < most; ++i) {
            way_[i] = i % 2 == 0 ? ways[i / 2] : ways[i / 2] * -1.0f;
            farthest_[i] = -infinity;
        }
    }
    void offer(const Vec3& place, float gap) {
        for (unsigned i = 0; i < most; ++i) {
            const float at = dot(way_[i], place);
            if (at <= farthest_[i]) continue;
            farthest_[i] = at;
            place_[i] = place;
            gap_[i] = gap;
        }
    }
    void add_to(Touches& touches, const Vec3& middle, const Vec3& normal, float apart) const {
        for (unsigned i = 0; i < most; ++i)
            if (farthest_[i] > -infinity) touches.add(middle + place_[i], normal, gap_[i], apart);
    }

private:
    static constexpr unsigned most = 8;
    Vec3 way_[most];
    float farthest_[most];
    Vec3 place_[most];
    float gap_[most];
};

/// Adds where the lower side of the hull, seen along the normal, lies over the triangle: the ends of that part.
void add_places_over(const HullBody& hull, const TriangleBeside& triangle, const Vec3& normal, float reach,
                     const Vec3& middle, Touches& touches) {
    const float steepness = dot(triangle.face, normal);
    if (absolute(steepness) < 0.25f) return;
    FarthestPlaces places(normal);
    const auto offer = [&](const Vec3& on_hull) {
        const float gap = dot(triangle.face, on_hull - triangle.corner[0]) / steepness;
        const Vec3 place = on_hull - normal * gap;
        if (gap <= reach && dot(normal, place) <= 0.0f) places.offer(place, gap);
    };
    const Prism prism(triangle.corner, normal);
    for (unsigned face = 0; face < hull.face_count; ++face) {
        const Vec3 outward = direction_of(hull.normal_of_face(face));
        const float facing = dot(outward, normal);
        if (dot(outward, outward) > 0.0f && facing > -0x1p-6f) continue;
        for (unsigned i = hull.first[face]; i < hull.first[face + 1u]; ++i) {
            const Vec3 from = hull.at(hull.from[i]), along = hull.at(hull.from[hull.next(face, i)]) - from;
            float low = 0.0f, high = 1.0f;
            if (!prism.clip(from, along, low, high)) continue;
            offer(from + along * low);
            offer(from + along * high);
        }
        if (!(facing < 0.0f)) continue;
        for (const Vec3& corner : triangle.corner) {
            if (!is_over(hull, face, normal * -1.0f, corner)) continue;
            const float gap = dot(outward, hull.at(hull.from[hull.first[face]]) - corner) / facing;
            if (gap <= reach && dot(normal, corner) <= 0.0f) places.offer(corner, gap);
        }
    }
    places.add_to(touches, middle, normal, hull.size * (1.0f / 64.0f));
}

}  // namespace

void touch_hull(const HullBody& hull, const LatticeTriangle& triangle, const FacingSide& side, float reach,
                Touches& touches) {
    const TriangleBeside beside(hull, triangle);
    Separation separation;
    Separating(hull, beside, separation);
    if (separation.gap > reach) return;
    const auto find_nearest = [&](const Vec3& moved) { return nearest_pair(hull, moved, beside); };
    FirstPlace first(separation, beside.size, find_nearest);
    if (first.distance > reach) return;
    touches.nearest = first.distance;
    touches.is_beside = !first.turn(
        beside, side, [&](GapAlong& along) { Separating(hull, beside, along); }, find_nearest);
    const Vec3 middle = to_vector(hull.middle) * hull.scale;
    touches.touch[0] = {middle + first.nearest.on_triangle, first.normal, first.distance, first.nearest.feature};
    touches.count = 1;
    add_places_over(hull, beside, first.normal, reach, middle, touches);
}

}  // namespace espalier::detail::contacts
