// Contacts of spheres and capsules: distances and features by the exact kernels, directions from exact integers.
#include <runtime/contacts/touch.hpp>
#include <runtime/kernels/point_triangle.hpp>
#include <runtime/kernels/segment_triangle.hpp>
#include <runtime/kernels/way_out.hpp>

namespace espalier::detail::contacts {

namespace {

/// Returns the part of v that is perpendicular to d, times d * d.
WideVector across(const Integer3& v, const Integer3& d) {
    const Int128 length = dot<Int128>(d, d), share = dot<Int128>(v, d);
    const auto coordinate = [&](std::int64_t of_v, std::int64_t of_d) {
        return multiply(length, of_v) - multiply(share, of_d);
    };
    return {coordinate(v.x, d.x), coordinate(v.y, d.y), coordinate(v.z, d.z)};
}

/// Returns the direction from a feature of the triangle to the origin, from which its corners are counted. The origin
/// is not on the feature; zero if it is.
Vec3 direction_from(Feature feature, const OriginRelative& t, const LatticeTriangle& triangle, int fraction_bits) {
    const Integer3 b = t.a + (t.ab << fraction_bits), c = t.a + (t.ac << fraction_bits);
    switch (feature) {
        case Feature::face:
            return face_normal_of(triangle) * (is_origin_behind(t) ? -1.0f : 1.0f);
        case Feature::edge_ab:
            return direction_of(-across(t.a, t.ab));
        case Feature::edge_bc:
            return direction_of(-across(b, t.ac - t.ab));
        case Feature::edge_ca:
            return direction_of(-across(c, t.ac));
        case Feature::vertex_a:
            return direction_of(-t.a);
        case Feature::vertex_b:
            return direction_of(-b);
        case Feature::vertex_c:
            break;
    }
    return direction_of(-c);
}

/// Returns the direction from the nearest feature to the inside of the segment; zero if there is none.
Vec3 direction_to_inside(const UnitSegment& segment, Feature feature, const LatticeTriangle& triangle) {
    const Integer3 along = segment.to - segment.from;
    const OriginRelative t = relative_to(segment.from, segment.fraction_bits, triangle);
    if (feature == Feature::face) return direction_from(feature, t, triangle, segment.fraction_bits);
    const auto number = static_cast<int>(feature);
    constexpr auto first_edge = static_cast<int>(Feature::edge_ab), first_vertex = static_cast<int>(Feature::vertex_a);
    const int corner = number >= first_vertex ? number - first_vertex : number - first_edge;
    const Integer3 to_corner = corner_on_grid(triangle, corner, segment.fraction_bits) - segment.from;
    if (number >= first_vertex) return direction_of(-across(to_corner, along));
    const WideVector normal = wide_cross(along, side_from(triangle, corner));
    if (is_zero(normal)) return direction_of(-across(to_corner, side_from(triangle, corner)));
    return direction_of(dot(normal, to_corner).is_negative() ? normal : -normal);
}

}  // namespace

Vec3 front_of(const LatticeTriangle& triangle) {
    const Vec3 normal = face_normal_of(triangle);
    if (dot(normal, normal) > 0.0f) return normal;
    Integer3 longest = {1, 0, 0};
    Int128 most = 0;
    for (int side = 0; side < 3; ++side) {
        const Integer3 d = side_from(triangle, side);
        const Int128 length = dot<Int128>(d, d);
        if (!(most < length)) continue;
        most = length;
        longest = d;
    }
    Integer3 axis = {0, 0, 0};
    axis[shortest_axis(magnitude(longest))] = 1;
    return direction_of(cross(longest, axis));
}

void touch_point(const RoundedPoint& point, const LatticeTriangle& triangle, const FacingSide& side, Touches& touches) {
    const PointDistance distance = distance_to(point, triangle);
    const OriginRelative t = relative_to(point, triangle);
    Vec3 normal = direction_from(distance.feature, t, triangle, point.fraction_bits);
    if (distance.squared == 0.0f || dot(normal, normal) == 0.0f) normal = front_of(triangle);
    touches.touch[0] = {point_of(triangle, distance.u, distance.v), normal,
                        square_root(distance.squared) + point.distance_offset, distance.feature};
    touches.count = 1;
    touches.nearest = touches.touch[0].distance;
    touches.is_beside = side.is_internal(distance.feature);
}

namespace {

/// A triangle and a segment in lattice steps, seen from the segment's start.
struct SeenFromStart {
    Vec3 start, along, corner[3];

    SeenFromStart(const RoundedSegment& segment, const LatticeTriangle& triangle)
        : start{segment.from_steps[0], segment.from_steps[1], segment.from_steps[2]},
          along(Vec3{segment.to_steps[0], segment.to_steps[1], segment.to_steps[2]} - start) {
        for (unsigned i = 0; i < 3; ++i) corner[i] = to_vector(triangle.corner[i]) - start;
    }
};

}  // namespace

void touch_nearest(const RoundedSegment& segment, const LatticeTriangle& triangle, const SegmentDistance& distance,
                   const FacingSide& side, Touches& touches) {
    Touch& first = touches.touch[0];
    first.point = point_of(triangle, distance.u, distance.v);
    first.feature = distance.feature;
    if (distance.squared == 0.0f) {
        const WayOut out = way_out(segment, triangle);
        first.normal = is_zero(out.axis) ? front_of(triangle) : out.normal;
        first.distance = -out.depth;
    } else {
        const bool at_from = distance.along <= 0.0f, at_to = distance.along >= 1.0f;
        const Integer3& end = at_to ? segment.to : segment.from;
        first.normal = at_from || at_to
                           ? direction_from(distance.feature, relative_to(end, segment.fraction_bits, triangle),
                                            triangle, segment.fraction_bits)
                           : direction_to_inside(segment, distance.feature, triangle);
        if (dot(first.normal, first.normal) == 0.0f) first.normal = front_of(triangle);
        first.distance = square_root(distance.squared);
    }
    touches.count = 1;
    touches.nearest = first.distance;
    if (distance.squared > 0.0f && !side.is_internal(first.feature)) return;

    const Vec3 face = face_normal_of(triangle);
    const auto [start, along, corner] = SeenFromStart(segment, triangle);
    const bool is_deep = distance.squared == 0.0f;
    const Vec3 middle = along * 0.5f;
    bool leads_through = false;  // the middle, after the way out
    for (const Vec3& at : corner) leads_through = leads_through || (is_deep && dot(first.normal, at - middle) > 0.0f);
    bool is_back = false;
    if (largest(face) > 0.0f && (leads_through || !side.keeps(first.feature, first.normal, face))) {
        const bool is_open = !side.finds_side(first.feature, face, is_back);
        if (is_open) {
            // The side on which most of what is over the triangle lies.
            float low = 0.0f, high = 1.0f;
            const bool is_over = Prism(corner, face).clip({}, along, low, high);
            is_back = is_over ? dot(face, along * (0.5f * (low + high)) - corner[0]) < 0.0f : side.is_back;
        }
        const Vec3 to_middle = start + middle - first.point;
        const float rounding = (largest(start) + largest(along)) * 0x1p-22f;
        bool is_turned = false;
        Vec3 outward = outward_from(face, is_back, to_middle, rounding, is_turned);
        if (is_open && side.is_bent(outward, face)) {
            outward = side.own_normal(face);
            is_turned = false;
        }
        float low = 0.0f, high = 1.0f;
        const bool is_over = Prism(corner, outward).clip({}, along, low, high);
        const float steepness = dot(face, outward), at_low = dot(face, along * low - corner[0]) / steepness,
                    at_high = dot(face, along * high - corner[0]) / steepness;
        touches.is_beside = !is_deep && !(is_over && maximum(at_low, at_high) >= 0.0f);
        if (!touches.is_beside) first.normal = outward;
        if (is_deep && is_over) {
            first.distance = minimum(first.distance, minimum(at_low, at_high));
            if (!is_turned) first.point = start + along * (at_low < at_high ? low : high) - outward * first.distance;
        }
    }
}

void touch_segment(const RoundedSegment& segment, const LatticeTriangle& triangle, const FacingSide& side, float reach,
                   Touches& touches) {
    touch_nearest(segment, triangle, distance_to(segment, triangle), side, touches);
    const Vec3 face = face_normal_of(triangle);
    const auto [start, along, corner] = SeenFromStart(segment, triangle);
    const Vec3 middle = along * 0.5f;

    // Where the segment lies over the face, both ends of that part touch it too.
    const Vec3 way = touches.touch[0].normal;
    const float steepness = dot(face, way);
    float low = 0.0f, high = 1.0f;
    if (absolute(steepness) < 0.25f || !Prism(corner, way).clip({}, along, low, high)) return;
    const float apart = largest(along) * (1.0f / 64.0f);
    for (const float share : {low, high}) {
        const Vec3 place = along * share;
        const float gap = dot(face, place - corner[0]) / steepness;
        const bool is_below_middle = dot(way, middle - (place - way * gap)) >= 0.0f;
        if (gap <= reach && is_below_middle) touches.add(start + (place - way * gap), way, gap, apart);
    }
}

}  // namespace espalier::detail::contacts
