// Contacts of boxes, in floats that are counted from the box's center: separating axes (Gottschalk, Lin and Manocha
// 1996) for the depth, pairs of features for the distance, and the part of a face over the triangle.
#include <runtime/contacts/touch.hpp>
#include <runtime/kernels/face.hpp>

namespace espalier::detail::contacts {

namespace {

/// Corners a, b, c from the box's center, in lattice steps.
struct SeenTriangle {
    Vec3 corner[3];

    [[nodiscard]] Vec3 at(float u, float v) const {
        return corner[0] + ((corner[1] - corner[0]) * u + (corner[2] - corner[0]) * v);
    }
};

/// The direction that separates most, from the triangle to the box, and the gap along it: below 0 the least depth.
struct Separation {
    Vec3 normal;
    float gap = -infinity;
};

void try_unit_axis(const Vec3& unit, const BoxBody& box, const SeenTriangle& seen, Separation& best) {
    float reach = 0.0f;
    for (const Vec3& half : box.half) reach += absolute(dot(unit, half));
    const float at[3] = {dot(unit, seen.corner[0]), dot(unit, seen.corner[1]), dot(unit, seen.corner[2])};
    const float low = minimum(minimum(at[0], at[1]), at[2]), high = maximum(maximum(at[0], at[1]), at[2]);
    const float above = low - reach, below = -high - reach;  // the triangle is ahead of the box, or behind it
    if (above > best.gap) best = {unit * -1.0f, above};
    if (below > best.gap) best = {unit, below};
}

void try_direction(const Vec3& axis, const BoxBody& box, const SeenTriangle& seen, Separation& best) {
    if (largest(axis) > 0.0f) try_unit_axis(direction_of(axis), box, seen, best);
}

Separation separate(const BoxBody& box, const SeenTriangle& seen, const Vec3& front) {
    Separation best;
    try_unit_axis(front, box, seen, best);
    bool is_flat = false;
    for (const Vec3& face : box.face) {
        if (dot(face, face) > 0.0f) try_unit_axis(face, box, seen, best);
        else is_flat = true;
    }
    for (const Vec3& half : box.half) {
        for (unsigned i = 0; i < 3; ++i) {
            const Vec3 side = seen.corner[i == 2 ? 0 : i + 1] - seen.corner[i];
            const Vec3 axis = cross(half, side);
            // Of nearly parallel edges the product is only rounding.
            if (dot(axis, axis) > dot(half, half) * dot(side, side) * 0x1p-20f)
                try_unit_axis(direction_of(axis), box, seen, best);
        }
    }
    if (!is_flat) return best;
    // Without volume, also the normals of each direction within whichever plane all may lie in.
    constexpr Vec3 units[3] = {{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};
    for (const Vec3& unit : units) {
        try_unit_axis(unit, box, seen, best);
        for (unsigned i = 0; i < 3; ++i) {
            try_direction(cross(unit, box.half[i]), box, seen, best);
            try_direction(cross(unit, seen.corner[i == 2 ? 0 : i + 1] - seen.corner[i]), box, seen, best);
        }
    }
    return best;
}

/// The nearest points of box and triangle.
struct NearestPair {
    float squared = infinity;
    Vec3 apart;  ///< from the triangle to the box
    Vec3 on_triangle;
    Feature feature = Feature::face;

    void offer(const Vec3& on_box, const Vec3& place, Feature part) {
        const Vec3 between = on_box - place;
        const float length = dot(between, between);
        if (length < squared) *this = {length, between, place, part};
    }
};

float clamped_share(float part, float whole) { return part <= 0.0f ? 0.0f : part >= whole ? 1.0f : part / whole; }

/// Returns the point of a side nearest to p and the part of the triangle that it lies on.
Vec3 nearest_on_side(const SeenTriangle& seen, unsigned side, const Vec3& p, Feature& feature) {
    const unsigned next = side == 2 ? 0 : side + 1;
    const Vec3& start = seen.corner[side];
    const Vec3 along = seen.corner[next] - start;
    const float share = clamped_share(dot(p - start, along), dot(along, along));
    const auto vertex = [](unsigned corner) {
        return static_cast<Feature>(static_cast<unsigned>(Feature::vertex_a) + corner);
    };
    feature = share == 0.0f   ? vertex(side)
              : share == 1.0f ? vertex(next)
                              : static_cast<Feature>(static_cast<unsigned>(Feature::edge_ab) + side);
    return start + along * share;
}

/// Offers the pair of a vertex of the box and the triangle: within its face or on a side.
void try_vertex(const Vec3& p, const SeenTriangle& seen, const Vec3& front, NearestPair& nearest) {
    bool is_over_face = true;
    for (unsigned i = 0; i < 3; ++i) {
        const Vec3 side = seen.corner[i == 2 ? 0 : i + 1] - seen.corner[i];
        if (dot(cross(side, p - seen.corner[i]), front) > 0.0f) continue;
        is_over_face = false;
        Feature feature = Feature::face;
        const Vec3 place = nearest_on_side(seen, i, p, feature);
        nearest.offer(p, place, feature);
    }
    if (is_over_face) nearest.offer(p, p - front * dot(front, p - seen.corner[0]), Feature::face);
}

/// Offers the nearest points of an edge of the box and a side of the triangle, ends included.
void try_edge(const Vec3& from, const Vec3& along, const SeenTriangle& seen, unsigned side, NearestPair& nearest) {
    const Vec3& start = seen.corner[side];
    const Vec3 d = seen.corner[side == 2 ? 0 : side + 1] - start, between = from - start;
    const float aa = dot(along, along), dd = dot(d, d), ad = dot(along, d);
    const float ab = dot(along, between), db = dot(d, between);
    const float whole = aa * dd - ad * ad;
    float s = whole > aa * dd * 0x1p-20f ? clamped_share(ad * db - dd * ab, whole) : 0.0f;
    Feature feature = Feature::face;
    const Vec3 place = nearest_on_side(seen, side, from + along * s, feature);
    s = clamped_share(dot(place - from, along), aa);
    nearest.offer(from + along * s, place, feature);
}

/// Offers the pair of a corner of the triangle and a face of the box, if the corner is over the face.
void try_corner(const BoxBody& box, const Vec3& moved, const SeenTriangle& seen, unsigned corner,
                NearestPair& nearest) {
    for (unsigned i = 0; i < 3; ++i) {
        const Vec3& face = box.face[i];
        if (!(dot(face, face) > 0.0f)) continue;
        const Vec3 &j = box.half[i == 2 ? 0 : i + 1], &k = box.half[i == 0 ? 2 : i - 1];
        for (const float sense : {-1.0f, 1.0f}) {
            const Vec3 from_face = seen.corner[corner] - (moved + box.half[i] * sense);
            const float jj = dot(j, j), kk = dot(k, k), jk = dot(j, k), whole = jj * kk - jk * jk;
            const float at_j = dot(from_face, j) * kk - dot(from_face, k) * jk;
            const float at_k = dot(from_face, k) * jj - dot(from_face, j) * jk;
            if (absolute(at_j) > whole || absolute(at_k) > whole) continue;
            const auto vertex = static_cast<Feature>(static_cast<unsigned>(Feature::vertex_a) + corner);
            nearest.offer(seen.corner[corner] - face * dot(face, from_face), seen.corner[corner], vertex);
        }
    }
}

/// Returns the nearest points of the box, moved by that much, and the triangle; they share no inner point.
NearestPair nearest_pair(const BoxBody& box, const Vec3& moved, const SeenTriangle& seen, const Vec3& front) {
    NearestPair nearest;
    for (unsigned i = 0; i < 3; ++i) try_corner(box, moved, seen, i, nearest);
    for (unsigned corner = 0; corner < 8; ++corner) {
        Vec3 p = moved;
        for (unsigned i = 0; i < 3; ++i) p = p + box.half[i] * ((corner >> i & 1u) != 0 ? 1.0f : -1.0f);
        try_vertex(p, seen, front, nearest);
        for (unsigned i = 0; i < 3; ++i) {
            if ((corner >> i & 1u) != 0) continue;
            for (unsigned side = 0; side < 3; ++side) try_edge(p, box.half[i] * 2.0f, seen, side, nearest);
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

void touch_box(const BoxBody& box, const LatticeTriangle& triangle, float reach, Touches& touches) {
    const float scale = power_of_two(-box.fraction_bits);
    SeenTriangle seen;
    for (int i = 0; i < 3; ++i) {
        const Integer3 from_center = corner_on_grid(triangle, i, box.fraction_bits) - box.center;
        seen.corner[i] = Vec3{to_float(from_center.x), to_float(from_center.y), to_float(from_center.z)} * scale;
    }
    const Vec3 front = front_of(triangle);
    const Separation separation = separate(box, seen, front);
    if (separation.gap > reach) return;
    const Vec3 moved = separation.gap < 0.0f ? separation.normal * -separation.gap : Vec3{};
    const NearestPair nearest = nearest_pair(box, moved, seen, front);
    const float distance = separation.gap < 0.0f ? separation.gap : square_root(nearest.squared);
    if (distance > reach) return;
    // The direction of an axis has less rounding than that between two points, where they agree or are hardly apart.
    const float size =
        box.size + maximum(maximum(largest(seen.corner[0]), largest(seen.corner[1])), largest(seen.corner[2]));
    const Vec3 off_axis = nearest.apart - separation.normal * distance;
    const bool is_of_axis = distance <= size * 0x1p-12f || largest(off_axis) < size * 0x1p-20f;
    const Vec3 normal = is_of_axis ? separation.normal : direction_of(nearest.apart);
    const Vec3 center = Vec3{to_float(box.center.x), to_float(box.center.y), to_float(box.center.z)} * scale;
    touches.touch[0] = {center + nearest.on_triangle, normal, distance, nearest.feature};
    touches.count = 1;

    const float steepness = dot(front, normal);
    if (absolute(steepness) < 0.25f) return;
    Polygon polygon = face_toward(box, normal);
    const Prism prism(seen.corner, normal);
    for (unsigned i = 0; i < Prism::plane_count; ++i) polygon.cut(prism.on_plane[i], prism.inward[i]);
    for (unsigned i = 0; i < polygon.count; ++i) {
        const float gap = dot(front, polygon.vertex[i] - seen.corner[0]) / steepness;
        if (gap <= reach)
            touches.add(center + (polygon.vertex[i] - normal * gap), normal, gap, box.size * (1.0f / 64.0f));
    }
}

}  // namespace espalier::detail::contacts
