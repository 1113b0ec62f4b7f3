// Contacts of boxes, in floats that are counted from the box's center: separating axes (Gottschalk, Lin and Manocha
// 1996) for the depth, pairs of features for the distance, and the part of a face over the triangle.
#include <runtime/contacts/nearest_pair.hpp>
#include <runtime/contacts/touch.hpp>

namespace espalier::detail::contacts {

namespace {

/// Offers both senses of an axis to a Separation or a GapAlong, unless it is zero.
template <class Best>
void try_unit_axis(const Vec3& unit, const BoxBody& box, const SeenTriangle& seen, Best& best) {
    if (!(dot(unit, unit) > 0.0f)) return;
    float reach = 0.0f;
    for (const Vec3& half : box.half) reach += absolute(dot(unit, half));
    const float at[3] = {dot(unit, seen.corner[0]), dot(unit, seen.corner[1]), dot(unit, seen.corner[2])};
    const float low = minimum(minimum(at[0], at[1]), at[2]), high = maximum(maximum(at[0], at[1]), at[2]);
    best.offer(unit * -1.0f, low - reach);  // the triangle is ahead of the box
    best.offer(unit, -high - reach);        // or behind it
}

template <class Best>
ESPALIER_NOINLINE void separate(const BoxBody& box, const SeenTriangle& seen, Best& best) {
    try_unit_axis(seen.front, box, seen, best);
    bool is_flat = false;
    for (const Vec3& face : box.face) {
        try_unit_axis(face, box, seen, best);
        is_flat = is_flat || !(dot(face, face) > 0.0f);
    }
    for (const Integer3& half : box.units) {
        // From integers: of nearly parallel edges floats would leave only rounding.
        for (const Integer3& side : seen.side) try_unit_axis(direction_of(cross(half, side)), box, seen, best);
    }
    if (!is_flat) return;
    // Without volume, also the normals of each direction within whichever plane all may lie in.
    constexpr Vec3 units[3] = {{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};
    for (const Vec3& unit : units) {
        try_unit_axis(unit, box, seen, best);
        for (unsigned i = 0; i < 3; ++i) {
            try_unit_axis(direction_of(cross(unit, box.half[i])), box, seen, best);
            try_unit_axis(direction_of(cross(unit, seen.along[i])), box, seen, best);
        }
    }
}

/// Offers the pair of a corner of the triangle and a face of the box, if the corner is over the face.
void try_corner(const BoxBody& box, const Vec3& moved, const SeenTriangle& seen, unsigned corner,
                NearestPair& nearest) {
    for (unsigned i = 0; i < 3; ++i) {
        const Vec3& face = box.face[i];
        if (!(dot(face, face) > 0.0f)) continue;
        const Vec3 &j = box.half[i == 2 ? 0 : i + 1], &k = box.half[i == 0 ? 2 : i - 1];
        const float whole = absolute(dot(cross(j, k), face)), jk = dot(j, k);
        const Vec3 diagonal = jk < 0.0f ? j - k : j + k;  // the longer one
        for (const float sense : {-1.0f, 1.0f}) {
            const Vec3 from_face = seen.corner[corner] - (moved + box.half[i] * sense);
            if (absolute(dot(cross(from_face, k), face)) > whole || absolute(dot(cross(j, from_face), face)) > whole)
                continue;
            // At a sharp corner of a sheared box the edges alone leave much room for rounding.
            if (absolute(dot(from_face, diagonal)) > dot(diagonal, diagonal)) continue;
            nearest.offer(seen.corner[corner] - face * dot(face, from_face), seen.corner[corner],
                          vertex_of(static_cast<int>(corner)));
        }
    }
}

/// A box and a triangle along four directions: the normals of the faces, and one that separates them. What is farther
/// apart along one of them than the nearest parts so far need not be tried: most pairs of an edge and a side, which take
/// longest.
class AlongDirections {
public:
    Vec3 vertex[8];         ///< of the moved box
    float rounding;         ///< what gaps and distances may be off by
    unsigned first_vertex;  ///< the one that reaches farthest toward the triangle
    unsigned first_corner;  ///< and that toward the box

    AlongDirections(const BoxBody& box, const Vec3& moved, const SeenTriangle& seen, const Vec3& way)
        : rounding((box.size + largest(moved) + seen.reach()) * 0x1p-17f), first_vertex(0), first_corner(0) {
        for (unsigned i = 0; i < 8; ++i) {
            vertex[i] = moved;
            for (unsigned k = 0; k < 3; ++k) vertex[i] = vertex[i] + box.half[k] * ((i >> k & 1u) != 0 ? 1.0f : -1.0f);
        }
        for (unsigned d = 0; d < 4; ++d) {
            const Vec3& unit = d < 3 ? box.face[d] : way;
            for (unsigned i = 0; i < 8; ++i) of_box_[d].add(of_vertex_[d][i] = dot(unit, vertex[i]));
            for (unsigned i = 0; i < 3; ++i) of_triangle_[d].add(of_corner_[d][i] = dot(unit, seen.corner[i]));
        }
        for (unsigned i = 1; i < 8; ++i)
            if (of_vertex_[3][i] < of_vertex_[3][first_vertex]) first_vertex = i;
        for (unsigned i = 1; i < 3; ++i)
            if (of_corner_[3][i] > of_corner_[3][first_corner]) first_corner = i;
    }
    [[nodiscard]] bool is_corner_within(float most, unsigned corner) const {
        return are_within(most, [&](unsigned d) { return gap({of_corner_[d][corner]}, of_box_[d]); });
    }
    [[nodiscard]] bool is_vertex_within(float most, unsigned at) const {
        return are_within(most, [&](unsigned d) { return gap({of_vertex_[d][at]}, of_triangle_[d]); });
    }
    [[nodiscard]] bool is_edge_within(float most, unsigned from, unsigned to) const {
        return are_within(most, [&](unsigned d) { return gap({of_vertex_[d][from], of_vertex_[d][to]}, of_triangle_[d]); });
    }
    [[nodiscard]] bool are_within(float most, unsigned from, unsigned to, unsigned side) const {
        const unsigned next = side == 2 ? 0 : side + 1;
        return are_within(most, [&](unsigned d) {
            return gap({of_vertex_[d][from], of_vertex_[d][to]}, {of_corner_[d][side], of_corner_[d][next]});
        });
    }

private:
    struct Range {
        float low = infinity, high = -infinity;

        Range() = default;
        Range(float at) : low(at), high(at) {}
        Range(float a, float b) : low(minimum(a, b)), high(maximum(a, b)) {}
        void add(float at) {
            low = minimum(low, at);
            high = maximum(high, at);
        }
    };
    static float gap(const Range& a, const Range& b) { return maximum(a.low - b.high, b.low - a.high); }
    template <class GapAt>
    static bool are_within(float most, GapAt gap_at) {
        return gap_at(3u) <= most && gap_at(0u) <= most && gap_at(1u) <= most && gap_at(2u) <= most;
    }

    float of_vertex_[4][8], of_corner_[4][3];
    Range of_box_[4], of_triangle_[4];
};

/// Returns the nearest points of the box, moved by that much, and the triangle; they share no inner point. `way` is any
/// unit vector from the triangle to the box: the better it separates them, the less is tried.
NearestPair nearest_pair(const BoxBody& box, const Vec3& moved, const SeenTriangle& seen, const Vec3& way) {
    const float scale = power_of_two(-box.fraction_bits);
    const AlongDirections along(box, moved, seen, way);
    NearestPair known;  // tried again below, in the order that decides between equals
    try_vertex(along.vertex[along.first_vertex], seen, known);
    try_corner(box, moved, seen, along.first_corner, known);
    NearestPair nearest;
    float most = square_root(known.squared) + along.rounding;
    const auto tighten = [&] { most = minimum(square_root(nearest.squared) + along.rounding, most); };
    for (unsigned i = 0; i < 3; ++i)
        if (along.is_corner_within(most, i)) try_corner(box, moved, seen, i, nearest);
    tighten();
    for (unsigned corner = 0; corner < 8; ++corner) {
        const Vec3& p = along.vertex[corner];
        if (along.is_vertex_within(most, corner)) {
            try_vertex(p, seen, nearest);
            tighten();
        }
        for (unsigned i = 0; i < 3; ++i) {
            const unsigned end = corner | 1u << i;
            if (end == corner || !along.is_edge_within(most, corner, end)) continue;
            for (unsigned side = 0; side < 3; ++side) {
                if (!along.are_within(most, corner, end, side)) continue;
                const Vec3 across = to_vector(cross(box.units[i], seen.side[side])) * (2.0f * scale);
                try_edge(p, box.half[i] * 2.0f, across, seen, side, nearest);
                tighten();
            }
        }
    }
    return nearest;
}

/// A convex polygon that is cut by planes.
struct Polygon {
    static constexpr unsigned most = 4 + Prism::plane_count;
    Vec3 vertex[most];
    unsigned count = 0;

    /// Keeps what lies on the side of the plane to which its normal points (Sutherland and Hodgman 1974).
    void cut(const Vec3& on_plane, const Vec3& normal) {
        Polygon kept;
        for (unsigned i = 0; i < count; ++i) {
            const Vec3 &here = vertex[i], &next = vertex[i + 1 == count ? 0 : i + 1];
            const float at = dot(here - on_plane, normal), at_next = dot(next - on_plane, normal);
            if (at >= 0.0f && kept.count != most) kept.vertex[kept.count++] = here;
            if ((at > 0.0f && at_next < 0.0f) || (at < 0.0f && at_next > 0.0f)) {
                if (kept.count != most) kept.vertex[kept.count++] = here + (next - here) * (at / (at - at_next));
            }
        }
        *this = kept;
    }
};

/// Returns the face of the box that looks at the triangle most.
Polygon face_toward(const BoxBody& box, const Vec3& normal) {
    unsigned facing = 0;
    float most = -1.0f;
    for (unsigned i = 0; i < 3; ++i) {
        const float along = absolute(dot(box.face[i], normal));
        if (along > most) {
            most = along;
            facing = i;
        }
    }
    const Vec3 &j = box.half[facing == 2 ? 0 : facing + 1], &k = box.half[facing == 0 ? 2 : facing - 1];
    const Vec3 middle = box.half[facing] * (dot(box.half[facing], normal) > 0.0f ? -1.0f : 1.0f);
    Polygon polygon;
    polygon.count = 4;
    polygon.vertex[0] = middle - j - k;
    polygon.vertex[1] = middle + j - k;
    polygon.vertex[2] = middle + j + k;
    polygon.vertex[3] = middle - j + k;
    return polygon;
}

}  // namespace

void touch_box(const BoxBody& box, const LatticeTriangle& triangle, const FacingSide& side, float reach,
               Touches& touches) {
    const SeenTriangle seen(triangle, box.center, box.fraction_bits);
    Separation separation;
    separate(box, seen, separation);
    if (separation.gap > reach) return;
    const auto find_nearest = [&](const Vec3& moved) { return nearest_pair(box, moved, seen, separation.normal); };
    FirstPlace first(separation, box.size + seen.reach(), find_nearest);
    if (first.distance > reach) return;
    touches.nearest = first.distance;
    touches.is_beside = !first.turn(
        seen, side, [&](GapAlong& along) { separate(box, seen, along); }, find_nearest);
    const Vec3 center = to_vector(box.center) * power_of_two(-box.fraction_bits), normal = first.normal;
    touches.touch[0] = {center + first.nearest.on_triangle, normal, first.distance, first.nearest.feature};
    touches.count = 1;

    const float steepness = dot(seen.face, normal);
    if (absolute(steepness) < 0.25f) return;
    Polygon polygon = face_toward(box, normal);
    const Prism prism(seen.corner, normal);
    for (unsigned i = 0; i < Prism::plane_count; ++i) polygon.cut(prism.on_plane[i], prism.inward[i]);
    for (unsigned i = 0; i < polygon.count; ++i) {
        const float gap = dot(seen.face, polygon.vertex[i] - seen.corner[0]) / steepness;
        const Vec3 place = polygon.vertex[i] - normal * gap;
        if (gap <= reach && dot(normal, place) <= 0.0f)
            touches.add(center + place, normal, gap, box.size * (1.0f / 64.0f));
    }
}

}  // namespace espalier::detail::contacts
