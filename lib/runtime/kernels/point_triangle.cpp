// The distance kernel: called once a candidate, not worth a copy in every instruction set.
#include <runtime/kernels/point_triangle.hpp>

namespace espalier::detail {

namespace {

/// Exactly; neither is the distance to a face.
ESPALIER_SHARED_CODE bool is_closer(const PointDistance& a, const PointDistance& b) {
    if (a.squared * distance_slack < b.squared) return true;
    if (b.squared * distance_slack < a.squared) return false;
    return compare_scaled(Unsigned256::product(a.numerator, b.denominator),
                          Unsigned256::product(b.numerator, a.denominator), 0) < 0;
}

/// Keeps the closest point of a side if it is closer than the best.
ESPALIER_SHARED_CODE void offer(PointDistance& best, const Integer3& from, const Integer3& edge, int bits,
                                const point_triangle::Side& name) {
    float along = 0.0f;
    PointDistance side = point_triangle::to_segment(from, edge, bits, name, along);
    if (!is_closer(side, best)) return;
    if (name.edge != Feature::edge_ca) side.u = name.edge == Feature::edge_ab ? along : 1.0f - along;
    if (name.edge != Feature::edge_ab) side.v = along;
    best = side;
}

/// Which sides the point is beyond of, or all of them when the triangle has no area.
struct Beyond {
    bool ab, ac, bc;
};

/// Computes the distance to the face where that is nearest; `p` is the point relative to corner a. Out of line in small
/// code, so that its variables are not on the stack together with those of the sides.
ESPALIER_SHARED_CODE bool is_over_face(const OriginRelative& t, const Integer3& p, int bits, PointDistance& face,
                                       Beyond& beyond) {
    const Integer3 normal = cross(t.ab, t.ac);
    const Int128 area = point_triangle::squared_length(normal);
    const Int128 weight_b = dot<Int128>(normal, cross(p, t.ac));
    const Int128 weight_c = dot<Int128>(normal, cross(t.ab, p));
    const Int128 weight_a = (area << bits) - weight_b - weight_c;
    const bool flat = area.is_zero();
    beyond = {flat || weight_c.is_negative(), flat || weight_b.is_negative(), flat || weight_a.is_negative()};
    if (beyond.ab || beyond.ac || beyond.bc) return false;

    const Int128 height = dot<Int128>(normal, p);
    const float whole = to_float(area << bits);
    face.numerator = magnitude(height);
    face.denominator = area;
    face.square_numerator = true;
    face.u = to_float(weight_b) / whole;
    face.v = to_float(weight_c) / whole;
    face.feature = feature_of(weight_a.is_zero(), weight_b.is_zero(), weight_c.is_zero());
    point_triangle::finish(face, bits);
    return true;
}

}  // namespace

PointDistance distance_to(const OriginRelative& t, int bits) noexcept {
    PointDistance best;
    const Integer3 p = -t.a;
    Beyond beyond;
    if (is_over_face(t, p, bits, best, beyond)) return best;
    // Outside of the prism over the face the closest point lies on a side that the point is beyond of.
    best.squared = infinity;
    if (beyond.ab) offer(best, p, t.ab, bits, point_triangle::side_ab);
    if (beyond.ac) offer(best, p, t.ac, bits, point_triangle::side_ac);
    if (beyond.bc) offer(best, p - (t.ab << bits), t.ac - t.ab, bits, point_triangle::side_bc);
    return best;
}

bool is_within_radius(const Unsigned256& numerator, const Int128& denominator, int fraction_bits,
                      float radius) noexcept {
    const auto [mantissa, exponent] = parts_of(radius);
    const Unsigned256 bound = Unsigned256::product(denominator, mantissa * mantissa);
    return compare_scaled(numerator, bound, 2 * (exponent + fraction_bits)) <= 0;
}

bool is_within_radius(const PointDistance& distance, int fraction_bits, float radius) noexcept {
    if (const int sure = sure_within(distance.squared, radius); sure != 0) return sure > 0;
    const Int128 factor = distance.square_numerator ? distance.numerator : Int128(1);
    return is_within_radius(Unsigned256::product(distance.numerator, factor), distance.denominator, fraction_bits,
                            radius);
}

}  // namespace espalier::detail
