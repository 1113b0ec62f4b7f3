// Cones: how they are rounded onto the lattice, what encloses them, and which triangles they overlap, decided in
// integers. docs/numerics.md has the proof and the widths.
#include <espalier/overlap.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/lattice/rounder.hpp>
#include <runtime/overlap/bounding_plane.hpp>
#include <runtime/overlap/find.hpp>

namespace espalier::detail {

/// The finest grid of axes, in fraction bits of a unit: also what heights are compared in.
constexpr int axis_bits = 16;

/// All points apex + X with 0 <= axis . X <= axis . D whose distance from the axis is at most (axis . X) / (axis . D)
/// of the radius, where D = axis * 2^axis_exponent leads to the middle of the base.
template <>
struct Rounded<Cone> : VolumeOf<Cone, 8> {
    int fraction_bits;  ///< 0..6; lengths are in units of 2^-fraction_bits steps
    int axis_exponent;  ///< -axis_bits..18
    Integer3 apex;
    Integer3 axis;       ///< not zero; below 2^24
    Int128 base_height;  ///< (axis . D) * 2^axis_bits
    FloatParts radius;   ///< in units
};

namespace {

/// A corner of a triangle, seen from the apex.
struct Corner {
    Integer3 at;
    Integer3 across;     ///< axis x at
    std::int64_t along;  ///< axis . at
    Int128 above_base;   ///< (axis . (at - D)) * 2^axis_bits
};

WideVector scaled(const Integer3& a, const Int128& by) {
    return {multiply(by, a.x), multiply(by, a.y), multiply(by, a.z)};
}

Unsigned256 squared_length(const WideVector& a) {
    const Int128 x = magnitude(a.x), y = magnitude(a.y), z = magnitude(a.z);
    return Unsigned256::product(x, x).plus(Unsigned256::product(y, y)).plus(Unsigned256::product(z, z));
}

/// Returns the sign of a * b + c * d.
int sign_of_sum(const Int128& a, const Int128& b, const Int128& c, const Int128& d) {
    const int first = sign(a) * sign(b), second = sign(c) * sign(d);
    if (first * second >= 0) return first != 0 ? first : second;
    return first * compare_scaled(Unsigned256::product(magnitude(a), magnitude(b)),
                                  Unsigned256::product(magnitude(c), magnitude(d)), 0);
}

/// Returns whether |off| <= radius * |per| * 2^exponent: each decision about the round surface has this form.
bool is_within_radius_of_cone(const Rounded<Cone>& cone, const WideVector& off, const WideVector& per, int exponent) {
    const auto& [mantissa, radius_exponent] = cone.radius;
    return compare_scaled(squared_length(off), squared_length(per * mantissa), 2 * (radius_exponent + exponent)) <= 0;
}

Corner corner_of(const Rounded<Cone>& cone, const LatticeTriangle& triangle, int number) {
    Corner corner;
    corner.at = corner_on_grid(triangle, number, cone.fraction_bits) - cone.apex;
    corner.across = cross(cone.axis, corner.at);
    corner.along = dot<std::int64_t>(cone.axis, corner.at);
    corner.above_base = (Int128(corner.along) << axis_bits) - cone.base_height;
    return corner;
}

bool is_inside(const Rounded<Cone>& cone, const Corner& corner) {
    if (corner.along < 0 || sign(corner.above_base) > 0) return false;
    return is_within_radius_of_cone(cone, wide_cross(cone.axis, corner.across), {corner.along, 0, 0},
                                    -cone.axis_exponent);
}

/// Returns whether the side from p to q, whose ends are outside, touches the cone.
bool side_meets(const Rounded<Cone>& cone, const Corner& p, const Corner& q) {
    const Integer3 side = q.at - p.at;
    const Integer3 normal = cross(p.at, side);  // of the plane through the apex and the side
    if (is_zero(normal)) {
        const Int128 between = dot<Int128>(p.at, q.at);
        if (between.is_negative()) return true;  // the apex is on the side
    }
    const WideVector turned = wide_cross(cone.axis, normal);
    // The direction across the normal that is closest to the axis is p * of_p + q * of_q.
    const Int128 of_p = dot<Int128>(q.across, normal), of_q = -dot<Int128>(p.across, normal);
    if (sign(of_p) > 0 && sign(of_q) > 0 && sign_of_sum(of_p, p.above_base, of_q, q.above_base) <= 0 &&
        is_within_radius_of_cone(cone, scaled(cone.axis, dot<Int128>(cone.axis, normal)), turned, -cone.axis_exponent))
        return true;
    if (sign(p.above_base) * sign(q.above_base) >= 0) return false;
    // Where the side crosses the plane of the base, as seen from its middle.
    const WideVector tilt = wide_cross(cone.axis, q.across - p.across);
    const int shift = cone.axis_exponent + axis_bits;
    return is_within_radius_of_cone(cone, (turned << axis_bits) - (tilt << shift), {q.along - p.along, 0, 0},
                                    axis_bits);
}

/// The plane of a triangle, seen from the apex.
struct TrianglePlane {
    Integer3 normal;
    Int128 offset;  ///< normal . corner
    Int128 along;   ///< normal . axis
};

/// Returns whether the axis, from the apex to the base, crosses the triangle; when it lies in the triangle's plane, no.
bool axis_meets(const Rounded<Cone>& cone, const Corner* corner, const TrianglePlane& plane) {
    const int side = sign(plane.along);
    if (side == 0 || sign(plane.offset) * side < 0) return false;
    for (int i = 0; i < 3; ++i) {
        const Integer3& next = corner[i == 2 ? 0 : i + 1].at;
        if (sign(dot<Int128>(corner[i].across, next)) * side < 0) return false;
    }
    return compare_scaled(Unsigned256(magnitude(plane.offset)), Unsigned256(magnitude(plane.along)),
                          cone.axis_exponent) <= 0;
}

/// Returns whether the segment that the triangle cuts out of the base's plane touches the base, between its ends.
bool base_meets(const Rounded<Cone>& cone, const Corner* corner, const TrianglePlane& plane) {
    const bool is_above[3] = {sign(corner[0].above_base) > 0, sign(corner[1].above_base) > 0,
                              sign(corner[2].above_base) > 0};
    if (is_above[0] == is_above[1] && is_above[1] == is_above[2]) return false;
    const int lonely = is_above[1] == is_above[2] ? 0 : is_above[0] == is_above[2] ? 1 : 2;
    const Corner& apart = corner[lonely];
    const WideVector line = wide_cross(plane.normal, cone.axis);
    const Int128 at_apart = -dot(line, apart.at);
    int side = 1;
    for (int i = 1; i < 3; ++i) {
        const Corner& other = corner[lonely + i < 3 ? lonely + i : lonely + i - 3];
        side *= sign_of_sum(apart.above_base, dot(line, other.at), other.above_base, at_apart);
    }
    if (side >= 0) return false;
    const Int128 off = (plane.along << (cone.axis_exponent + axis_bits)) - (plane.offset << axis_bits);
    return is_within_radius_of_cone(cone, scaled(cone.axis, off), line, axis_bits);
}

}  // namespace

/// Returns whether the triangle and the cone share a point, exactly.
bool meets(const Rounded<Cone>& cone, const LatticeTriangle& triangle) {
    const Corner corner[3] = {corner_of(cone, triangle, 0), corner_of(cone, triangle, 1), corner_of(cone, triangle, 2)};
    bool is_behind = true, is_beyond = true;
    for (const Corner& c : corner) {
        is_behind = is_behind && c.along < 0;
        is_beyond = is_beyond && sign(c.above_base) > 0;
    }
    if (is_behind || is_beyond) return false;
    for (const Corner& c : corner)
        if (is_inside(cone, c)) return true;
    const Integer3 normal = cross(corner[1].at - corner[0].at, corner[2].at - corner[0].at);
    const TrianglePlane plane = {normal, dot<Int128>(normal, corner[0].at), dot<Int128>(normal, cone.axis)};
    if (axis_meets(cone, corner, plane)) return true;
    for (int i = 0; i < 3; ++i)
        if (side_meets(cone, corner[i], corner[i == 2 ? 0 : i + 1])) return true;
    return base_meets(cone, corner, plane);
}

namespace {

/// Adds a plane that bounds the cone: for each of its points X, normal . (X - at) <= reach. `size` is at least
/// |X - at|, summed over the axes of space.
void add_plane(Rounded<Cone>& cone, const Integer3& normal, const Integer3& at, std::int64_t reach, std::int64_t size) {
    cone.add_plane(bounding_plane({{normal.x, normal.y, normal.z}, at, reach, size}, cone.fraction_bits));
}

/// Adds two planes for each axis of space: through the apex, along the slope, and parallel to that axis but for the
/// slope. With n perpendicular to the cone's axis, n . X <= |n| radius (axis . X) / (axis . D).
void add_slopes(Rounded<Cone>& cone, float radius, std::int64_t size) {
    constexpr int slope_bits = 20;
    const Integer3& a = cone.axis;
    const float unit = power_of_two(cone.fraction_bits - cone.axis_exponent);
    for (const Integer3& n : {Integer3{0, a.z, -a.y}, Integer3{-a.z, 0, a.x}, Integer3{a.y, -a.x, 0}}) {
        const float length = square_root(to_float(dot<std::int64_t>(n, n)));
        const float slope = length * radius / to_float(dot<std::int64_t>(a, a)) * unit * (1.0f + 0x1p-18f);
        if (!(slope < 0x1p15f)) continue;
        const std::int64_t outward = to_integer(slope * power_of_two(slope_bits)) + 1;
        for (const std::int64_t side : {std::int64_t{1} << slope_bits, -(std::int64_t{1} << slope_bits)})
            add_plane(cone, n * side - a * outward, cone.apex, 0, size);
    }
}

/// Sets bounds and planes; `radius` is in steps.
void enclose(Rounded<Cone>& cone, float radius) {
    cone.bounded = radius < static_cast<float>(bounds_limit);
    if (!cone.bounded) return;
    const int bits = cone.fraction_bits, exponent = cone.axis_exponent;
    const std::int64_t reach = (to_integer(radius * (1.0f + 0x1p-20f)) + 1) * (std::int64_t{1} << bits);
    std::int64_t size = 3 * reach;
    const auto bound = [&](int k, std::int64_t from, std::int64_t axis) {
        const std::int64_t rise = exponent < 0 ? axis >> -exponent : axis * (std::int64_t{1} << exponent);
        const std::int64_t low = from + rise - reach, high = from + rise + 1 + reach;
        cone.set_bounds(k, low < from ? low : from, from < high ? high : from, bits);
        size += magnitude(rise) + 2;
        return from + rise;
    };
    const Integer3& a = cone.axis;
    const Integer3 base = {bound(0, cone.apex.x, a.x), bound(1, cone.apex.y, a.y), bound(2, cone.apex.z, a.z)};
    add_plane(cone, -a, cone.apex, 0, size);
    // The plane of a base farther away bounds nothing on the lattice, and its offset would not fit.
    if (size < std::int64_t{1} << 36) add_plane(cone, a, base, sum_of_magnitudes(a), size);
    add_slopes(cone, radius, size);
}

}  // namespace

QueryStatus round_volume(const BlobData& blob, const Cone& local, Rounded<Cone>& cone) {
    if (!is_finite(local.apex) || !is_finite(local.axis) || !is_radius(local.radius) || !is_finite(local.radius))
        return QueryStatus::invalid_argument;
    float apex[3], axis[3];
    Rounder place(blob), length(blob);
    place.add_point(local.apex, apex);
    length.add_vector(local.axis, axis);
    if (!(place.reach() < shape_reach) || !(length.reach() < shape_reach)) return QueryStatus::out_of_range;
    cone.fraction_bits = fraction_bits_for(place.reach(), volume_grid);
    cone.apex = to_grid(apex, cone.fraction_bits);
    // The longest coordinate of the axis keeps all of its 24 bits, unless it is shorter than 2^(23 - axis_bits) units.
    const int exponent = exponent_of(length.reach()) - 23 + cone.fraction_bits;
    cone.axis_exponent = exponent < -axis_bits ? -axis_bits : exponent;
    cone.axis = to_grid(axis, cone.fraction_bits - cone.axis_exponent);
    if (is_zero(cone.axis)) return QueryStatus::invalid_argument;
    cone.base_height = Int128(dot<std::int64_t>(cone.axis, cone.axis)) << (cone.axis_exponent + axis_bits);
    cone.radius = parts_of(local.radius);
    cone.radius.exponent += cone.fraction_bits - blob.step_exponent;
    enclose(cone, radius_in_steps(blob, local.radius));
    return QueryStatus::ok;
}

template QueryStatus find_overlaps_of<Cone>(const BlobData&, const void*, Each&, const WalkAccuracy&);

}  // namespace espalier::detail
