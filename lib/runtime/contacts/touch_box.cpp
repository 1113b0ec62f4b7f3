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

/// Which parts of a box and a triangle may be nearest: bounds on their distances from a direction and from the box's
/// size, beside how near a corner of the box is. Most pairs of an edge and a side are too far, and take longest.
struct NearParts {
    Vec3 vertex[8];  ///< of the moved box
    bool has_near_vertex[8];
    bool has_near_corner[3], has_near_side[3];

    NearParts(const BoxBody& box, const Vec3& moved, const SeenTriangle& seen, const Vec3& way) {
        NearestPair known;
        float at[8], low = infinity;
        for (unsigned i = 0; i < 8; ++i) {
            vertex[i] = moved;
            for (unsigned k = 0; k < 3; ++k) vertex[i] = vertex[i] + box.half[k] * ((i >> k & 1u) != 0 ? 1.0f : -1.0f);
            try_vertex(vertex[i], seen, known);
            at[i] = dot(way, vertex[i]);
            low = minimum(at[i], low);
        }
        const float rounding = (box.size + largest(moved) + seen.reach()) * 0x1p-17f;
        const float most = square_root(known.squared) + rounding;
        float to_corner[3], high = -infinity;
        for (unsigned i = 0; i < 3; ++i) {
            to_corner[i] = dot(way, seen.corner[i]);
            high = maximum(to_corner[i], high);
        }
        const auto reaches = [&](const Vec3& place) {
            const Vec3 from_middle = place - moved;
            const float far = box.size + most;
            return dot(from_middle, from_middle) <= far * far * (1.0f + 0x1p-18f);
        };
        for (unsigned i = 0; i < 8; ++i) has_near_vertex[i] = at[i] - high <= most;
        for (unsigned i = 0; i < 3; ++i) {
            Feature feature = Feature::face;
            has_near_corner[i] = low - to_corner[i] <= most && reaches(seen.corner[i]);
            has_near_side[i] = reaches(nearest_on_side(seen, i, moved, feature));
        }
    }
};

/// Returns the nearest points of the box, moved by that much, and the triangle; they share no inner point. `way` is any
/// unit vector from the triangle to the box: the better it separates them, the less is tried.
NearestPair nearest_pair(const BoxBody& box, const Vec3& moved, const SeenTriangle& seen, const Vec3& way) {
    const float scale = power_of_two(-box.fraction_bits);
    const NearParts near(box, moved, seen, way);
    NearestPair nearest;
    for (unsigned i = 0; i < 3; ++i)
        if (near.has_near_corner[i]) try_corner(box, moved, seen, i, nearest);
    for (unsigned corner = 0; corner < 8; ++corner) {
        const Vec3& p = near.vertex[corner];
        if (near.has_near_vertex[corner]) try_vertex(p, seen, nearest);
        for (unsigned i = 0; i < 3; ++i) {
            if ((corner >> i & 1u) != 0 || !(near.has_near_vertex[corner] || near.has_near_vertex[corner | 1u << i]))
                continue;
            for (unsigned side = 0; side < 3; ++side) {
                if (!near.has_near_side[side]) continue;
                const Vec3 across = to_vector(cross(box.units[i], seen.side[side])) * (2.0f * scale);
                try_edge(p, box.half[i] * 2.0f, across, seen, side, nearest);
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
