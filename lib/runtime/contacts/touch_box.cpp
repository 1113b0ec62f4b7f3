// Contacts of boxes, in floats that are counted from the box's center: separating axes (Gottschalk, Lin and Manocha
// 1996) for the depth, pairs of features for the distance, and the part of a face over the triangle.
#include <runtime/base/vector.hpp>
#include <runtime/contacts/nearest_pair.hpp>
#include <runtime/contacts/touch.hpp>

namespace espalier::detail::contacts {

namespace {

/// Four numbers, one for each of four directions. Small cores take one direction at a time.
constexpr unsigned direction_count = small_code ? 1 : 4;
using Along = Vector<float, direction_count>;

inline Along lesser(Along a, Along b) { return a < b ? a : b; }
inline Along greater(Along a, Along b) { return a > b ? a : b; }
template <class Floats>
bool any_is_positive(Floats a) {
    if constexpr (sizeof a == sizeof(float)) return a[0] > 0.0f;
    else {
        const auto halves = std::bit_cast<Vector<std::int64_t, 2>>(a > 0.0f);
        return (halves[0] | halves[1]) != 0;
    }
}

struct Directions {
    Along x, y, z;

    Directions() = default;
    Directions(const Vec3& first, [[maybe_unused]] const Vec3* others) {
#if ESPALIER_SMALL_CODE
        x[0] = first.x, y[0] = first.y, z[0] = first.z;
#else
        x = Along{first.x, others[0].x, others[1].x, others[2].x};
        y = Along{first.y, others[0].y, others[1].y, others[2].y};
        z = Along{first.z, others[0].z, others[1].z, others[2].z};
#endif
    }
    [[nodiscard]] Vec3 get(unsigned d) const { return {x[d], y[d], z[d]}; }
    [[nodiscard]] Along of(const Vec3& point) const { return x * point.x + y * point.y + z * point.z; }
#if !ESPALIER_SMALL_CODE
    /// direction_of() each.
    void normalise() {
        const Along size = greater(greater(greater(x, -x), greater(y, -y)), greater(z, -z));
        const Along divisor = size > 0.0f ? size : Along{} + 1.0f;
        x = x / divisor, y = y / divisor, z = z / divisor;
        const Along squared = x * x + y * y + z * z;
        Along length = {square_root(squared[0]), square_root(squared[1]), square_root(squared[2]),
                        square_root(squared[3])};
        length = size > 0.0f ? length : divisor;
        x = x / length, y = y / length, z = z / length;
    }
#endif
};

/// Directions that may separate a box and a triangle, with the gap along each: where the triangle is ahead of the box,
/// and where it is behind it.
struct Gaps {
    Directions unit;
    Along ahead, behind;

    void find(const BoxBody& box, const SeenTriangle& seen) {
        Along reach = {};
        for (const Vec3& half : box.half) {
            const Along at = unit.of(half);
            reach = reach + greater(at, -at);
        }
        const Along a = unit.of(seen.corner[0]), b = unit.of(seen.corner[1]), c = unit.of(seen.corner[2]);
        const Along none = Along{} - infinity, length = unit.x * unit.x + unit.y * unit.y + unit.z * unit.z;
        ahead = length > 0.0f ? lesser(lesser(a, b), c) - reach : none;
        behind = length > 0.0f ? -greater(greater(a, b), c) - reach : none;
    }
    /// Offers both senses of each direction.
    template <class Best>
    void offer_to(Best& best) const {
        for (unsigned d = 0; d < direction_count; ++d) {
            if (!(ahead[d] > -infinity)) continue;
            best.offer(unit.get(d) * -1.0f, ahead[d]);
            best.offer(unit.get(d), behind[d]);
        }
    }
};

/// The directions that may separate a box and a triangle, with the gaps along each, found once for all that asks for
/// them: the products, roots and quotients of thirteen directions take as long as the rest of a contact.
class SeparatingAxes {
public:
    Separation separation;  ///< incomplete once its gap is above the reach

    SeparatingAxes(const BoxBody& box, const SeenTriangle& seen, float reach) : box_(box), seen_(seen) {
        bool is_flat = false;
        for (const Vec3& face : box.face) is_flat = is_flat || !(dot(face, face) > 0.0f);
        count_ = is_flat ? most : of_volume;
        for (unsigned i = 0; i < count_ && !(separation.gap > reach); ++i) {
            Gaps other;
            Gaps& gaps = takes_shortcut(i < of_volume) ? gaps_[i] : other;
            find(i, gaps);
            if (any_is_positive(greater(gaps.ahead, gaps.behind) - separation.gap)) gaps.offer_to(separation);
        }
    }
    void offer_all(GapAlong& along) const {
        for (unsigned i = 0; i < count_; ++i) {
            if (takes_shortcut(i < of_volume)) {
                gaps_[i].offer_to(along);
            } else {
                Gaps gaps;
                find(i, gaps);
                gaps.offer_to(along);
            }
        }
    }

private:
    // The normals of the triangle and of the faces, and the products of edges and sides: together in four groups, or
    // one by one. Without volume, also the normals of each direction within whichever plane all may lie in.
    static constexpr unsigned of_volume = small_code ? 4 + 9 : 1 + 3, most = of_volume + 21;

    ESPALIER_NOINLINE void find(unsigned number, Gaps& gaps) const {
        const Vec3 zero[3] = {};
        if (number >= of_volume) {
            gaps.unit = Directions(axis_in_plane(number - of_volume), zero);
#if ESPALIER_SMALL_CODE
        } else if (number >= 4) {
            gaps.unit = Directions(direction_of(product((number - 4) / 3, (number - 4) % 3)), zero);
        } else {
            gaps.unit = Directions(number == 0 ? seen_.front : box_.face[number - 1], zero);
#else
        } else if (number > 0) {
            const Vec3 others[3] = {product(number - 1, 1), product(number - 1, 2), {}};
            gaps.unit = Directions(product(number - 1, 0), others);
            gaps.unit.normalise();
        } else {
            gaps.unit = Directions(seen_.front, box_.face);
#endif
        }
        gaps.find(box_, seen_);
    }
    /// From integers: of nearly parallel edges floats would leave only rounding.
    [[nodiscard]] Vec3 product(unsigned half, unsigned side) const {
        return to_vector(cross(box_.units[half], seen_.side[side]));
    }
    [[nodiscard]] Vec3 axis_in_plane(unsigned number) const {
        constexpr Vec3 units[3] = {{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};
        const Vec3& unit = units[number / 7];
        if (number % 7 == 0) return unit;
        const unsigned i = (number % 7 - 1) / 2;
        return direction_of(cross(unit, number % 7 % 2 == 1 ? box_.half[i] : seen_.along[i]));
    }

    const BoxBody& box_;
    const SeenTriangle& seen_;
    unsigned count_;
    Uninitialised<Gaps, small_code ? 1 : of_volume> gaps_;  ///< of the groups; small cores have no stack for them
};

/// Offers the pair of a corner of the triangle and a face of the box, if the corner is over the face and no farther
/// from it than `most`.
void try_corner(const BoxBody& box, const Vec3& moved, const SeenTriangle& seen, unsigned corner, float most,
                NearestPair& nearest) {
    for (unsigned i = 0; i < 3; ++i) {
        const Vec3& face = box.face[i];
        if (!(dot(face, face) > 0.0f)) continue;
        const Vec3 &j = box.half[i == 2 ? 0 : i + 1], &k = box.half[i == 0 ? 2 : i - 1];
        const float whole = absolute(dot(cross(j, k), face)), jk = dot(j, k);
        const Vec3 diagonal = jk < 0.0f ? j - k : j + k;  // the longer one
        for (const float sense : {-1.0f, 1.0f}) {
            const Vec3 from_face = seen.corner[corner] - (moved + box.half[i] * sense);
            const float height = dot(face, from_face);
            if (absolute(height) > most) continue;
            if (absolute(dot(cross(from_face, k), face)) > whole || absolute(dot(cross(j, from_face), face)) > whole)
                continue;
            // At a sharp corner of a sheared box the edges alone leave much room for rounding.
            if (absolute(dot(from_face, diagonal)) > dot(diagonal, diagonal)) continue;
            nearest.offer(seen.corner[corner] - face * height, seen.corner[corner],
                          vertex_of(static_cast<int>(corner)));
        }
    }
}

/// How far something reaches along one direction that separates box and triangle, and the normals of the faces. Small
/// cores have the first only.
struct Extents {
    Along low, high;

    Extents() = default;
    explicit Extents(Along at) : low(at), high(at) {}
    Extents(const Extents& a, const Extents& b) : low(lesser(a.low, b.low)), high(greater(a.high, b.high)) {}

    /// Whether the gap between both is at most that, whatever the direction.
    [[nodiscard]] bool is_within(float most, const Extents& other) const {
        return !any_is_positive(greater(low - other.high, other.low - high) - most);
    }
};

/// Returns the nearest points of the box, moved by that much, and the triangle; they share no inner point. `way` is any
/// unit vector from the triangle to the box. What is farther apart along a direction than the nearest parts so far need
/// not be tried: the better `way` separates both, the fewer pairs of an edge and a side are left, which take longest.
NearestPair nearest_pair(const BoxBody& box, const Vec3& moved, const SeenTriangle& seen, const Vec3& way) {
    const Directions directions(way, box.face);
    Uninitialised<Vec3, 8> vertex;
    Extents corner[3], at_vertex[8];
    for (unsigned i = 0; i < 3; ++i) corner[i] = Extents(directions.of(seen.corner[i]));
    for (unsigned i = 0; i < 8; ++i) {
        vertex[i] = moved;
        for (unsigned k = 0; k < 3; ++k) vertex[i] = vertex[i] + box.half[k] * ((i >> k & 1u) != 0 ? 1.0f : -1.0f);
        at_vertex[i] = Extents(directions.of(vertex[i]));
    }
    const Extents side[3] = {{corner[0], corner[1]}, {corner[1], corner[2]}, {corner[2], corner[0]}};
    const Extents triangle(side[0], corner[2]);
    Extents whole = at_vertex[0];
    unsigned first_vertex = 0, first_corner = 0;  // those that reach farthest toward the other one
    for (unsigned i = 1; i < 8; ++i) {
        whole = Extents(whole, at_vertex[i]);
        if (at_vertex[i].low[0] < at_vertex[first_vertex].low[0]) first_vertex = i;
    }
    for (unsigned i = 1; i < 3; ++i)
        if (corner[i].high[0] > corner[first_corner].high[0]) first_corner = i;

    // More than gaps and distances can round (docs/numerics.md, *Contacts of bodies*): what is skipped is strictly
    // farther than a pair that is tried.
    const float rounding = (box.size + largest(moved) + seen.reach()) * 0x1p-16f;
    const auto bound_of = [rounding](const NearestPair& pair) { return square_root(pair.squared) + rounding; };
    NearestPair known;  // tried again below, in the order that decides between equals
    try_vertex(vertex[first_vertex], seen, known);
    try_corner(box, moved, seen, first_corner, bound_of(known), known);

    NearestPair nearest;
    float most = bound_of(known);
    for (unsigned i = 0; i < 3; ++i)
        if (corner[i].is_within(most, whole)) try_corner(box, moved, seen, i, most, nearest);
    const float scale = power_of_two(-box.fraction_bits);
    for (unsigned from = 0; from < 8 && nearest.squared != 0.0f; ++from) {
        if (at_vertex[from].is_within(most, triangle)) {
            try_vertex(vertex[from], seen, nearest);
            most = minimum(bound_of(nearest), most);
        }
        for (unsigned i = 0; i < 3; ++i) {
            const unsigned to = from | 1u << i;
            if (to == from) continue;
            const Extents edge(at_vertex[from], at_vertex[to]);
            if (!edge.is_within(most, triangle)) continue;
            for (unsigned k = 0; k < 3; ++k) {
                if (!edge.is_within(most, side[k])) continue;
                const Vec3 across = to_vector(cross(box.units[i], seen.side[k])) * (2.0f * scale);
                try_edge(vertex[from], box.half[i] * 2.0f, across, seen, k, nearest);
                most = minimum(bound_of(nearest), most);
            }
        }
    }
    return nearest;
}

/// A convex polygon that is cut by planes.
struct Polygon {
    static constexpr unsigned most = 4 + Prism::plane_count;
    Uninitialised<Vec3, most> vertex;
    unsigned count = 0;

    /// Keeps what lies on the side of the plane to which its normal points (Sutherland and Hodgman 1974).
    void cut(const Vec3& on_plane, const Vec3& normal) {
        float at[most];
        bool is_cut = false;
        for (unsigned i = 0; i < count; ++i) {
            at[i] = dot(vertex[i] - on_plane, normal);
            is_cut = is_cut || !(at[i] >= 0.0f);
        }
        if (!is_cut) return;
        Polygon kept;
        for (unsigned i = 0; i < count; ++i) {
            const unsigned next = i + 1 == count ? 0 : i + 1;
            if (at[i] >= 0.0f && kept.count != most) kept.vertex[kept.count++] = vertex[i];
            if ((at[i] > 0.0f && at[next] < 0.0f) || (at[i] < 0.0f && at[next] > 0.0f)) {
                const float share = at[i] / (at[i] - at[next]);
                if (kept.count != most) kept.vertex[kept.count++] = vertex[i] + (vertex[next] - vertex[i]) * share;
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
    const SeparatingAxes axes(box, seen, reach);
    const Separation& separation = axes.separation;
    if (separation.gap > reach) return;
    const auto find_nearest = [&](const Vec3& moved) { return nearest_pair(box, moved, seen, separation.normal); };
    FirstPlace first(separation, box.size + seen.reach(), find_nearest);
    if (first.distance > reach) return;
    touches.nearest = first.distance;
    touches.is_beside = !first.turn(
        seen, side, [&](GapAlong& along) { axes.offer_all(along); }, find_nearest);
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
