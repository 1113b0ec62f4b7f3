// The places where a segment and a triangle may be nearest to each other: also those of two triangles.
#pragma once

#include <runtime/base/wide_difference.hpp>
#include <runtime/kernels/segment_triangle.hpp>

namespace espalier::detail {

// Gram determinants: differences of two products, of int64 factors where those suffice, or of 128-bit ones.

inline float quotient(Argument<Int128> numerator, Argument<Int128> denominator) {
    return to_float(numerator) / to_float(denominator);
}
/// Both scaled down alike: the largest numerator then fits, and 1 over the largest denominator stays normal.
ESPALIER_SHARED_CODE inline float quotient(const WideDifference& numerator, const WideDifference& denominator) {
    return to_float(numerator.magnitude, -30) / to_float(denominator.magnitude, -30);
}
/// Whether a < b * 2^shift, of numbers above 0.
inline bool is_less(const Int128& a, const Int128& b, int shift) { return a < b << shift; }
inline bool is_less(const WideDifference& a, const WideDifference& b, int shift) {
    return compare_scaled(a.magnitude, b.magnitude, shift) < 0;
}
/// Whether (a * b - c * d) / whole lies inside of 0 to 2^shift, and then what it is.
template <class Dot, class Difference>
ESPALIER_SHARED_CODE bool is_share(const Dot& a, const Dot& b, const Dot& c, const Dot& d, const Difference& whole,
                                   int shift, float& share) {
    const Difference part = product_difference(a, b, c, d);
    if (part.is_negative() || part.is_zero() || !is_less(part, whole, shift)) return false;
    share = quotient(part, whole);
    return true;
}
/// Lines of huge segments may pass a side by less than 2^-63 steps: returned as 2^-63, neither subnormal nor 0.
inline constexpr float least_squared = 0x1p-126f;

/// What floats rule out of the places where a segment and a triangle may be nearest: most of them, in a fraction of the
/// time that each takes (docs/numerics.md, *Segment against triangle*). Coordinates stay below 2^31.
class PlacesInFloats {
public:
    PlacesInFloats(const OriginRelative& t, const Integer3& d, const Integer3* w, float scale)
        : way_(scaled(d)), edge_{scaled(t.ab), scaled(t.ac - t.ab), scaled(-t.ac)} {
        for (unsigned i = 0; i < 3; ++i) corner_[i] = scaled(w[i]);
        const Vec3 direction = cross(edge_[0], edge_[2]);
        const float at[3] = {dot(direction, corner_[0]), dot(direction, corner_[1]), dot(direction, corner_[2])};
        low_ = minimum(at[0], minimum(at[1], at[2]));
        high_ = maximum(at[0], maximum(at[1], at[2]));
        end_ = dot(direction, way_);
        const float size =
            maximum(largest(corner_[0]), maximum(largest(corner_[1]), largest(corner_[2]))) + largest(way_);
        rounding_ = sum_of_magnitudes(direction) * size * 0x1p-18f;
        to_squared_ = scale * 0x1p32f / (dot(direction, direction) * (1.0f + 0x1p-18f) + 0x1p-80f);
    }
    /// Whether both ends of the segment are on one side of the plane.
    [[nodiscard]] bool is_on_one_side() const {
        return (low_ > rounding_ && low_ - end_ > rounding_) || (high_ < -rounding_ && high_ - end_ < -rounding_);
    }
    /// Returns a lower bound of the squared distance of an end of the segment.
    [[nodiscard]] float bound_of_end(bool is_second) const {
        const float from = is_second ? end_ : 0.0f;
        const float gap = maximum(maximum(low_ - from, from - high_) - rounding_, 0.0f);
        return gap * gap * to_squared_;
    }
    /// Whether the line of the segment and that of a side are surely not nearest within both.
    [[nodiscard]] bool rules_out_side(unsigned i, int fraction_bits) const {
        const Vec3 &w = corner_[i], &e = edge_[i];
        const float length = dot(way_, way_), ee = dot(e, e), de = dot(way_, e), wd = dot(w, way_), we = dot(w, e);
        const float whole = length * ee - de * de, size = dot(w, w), error = length * ee * 0x1p-18f;
        const float along = wd * ee - we * de, of_along = (size + length) * ee * 0x1p-18f;
        if (along < -of_along || along > whole + error + of_along) return true;
        const float share = wd * de - we * length, of_share = (size + ee) * length * 0x1p-18f;
        return share < -of_share || share > (whole + error) * power_of_two(fraction_bits) + of_share;
    }

private:
    static Vec3 scaled(const Integer3& a) { return to_vector(a) * 0x1p-16f; }

    Vec3 way_, corner_[3], edge_[3];
    float low_, high_, end_;  ///< how far the corners and the end of the segment are along the normal
    float rounding_;
    float to_squared_;  ///< from squares along it to squared lattice steps
};

/// Tries the places where the distance may be reached, and keeps the nearest. Given a radius, it also decides
/// for each that is not clearly nearer or farther, exactly, whether it is within.
class SegmentPlaces {
public:
    explicit SegmentPlaces(int fraction_bits, float radius = -1.0f)
        : fraction_bits_(fraction_bits), radius_(radius), scale_(power_of_two(-2 * fraction_bits)) {}

    [[nodiscard]] const SegmentDistance& nearest() const { return nearest_; }
    [[nodiscard]] bool is_any_within() const { return within_; }

    void try_all(const UnitSegment& segment, const LatticeTriangle& triangle) {
        OriginRelative from_start = relative_to(segment.from, fraction_bits_, triangle);
        if (takes_shortcut() && is_zero(segment.to - segment.from)) return try_end(from_start, 0.0f);
        const Integer3 d = segment.to - segment.from, b = corner_on_grid(triangle, 1, fraction_bits_) - segment.from;
        const Integer3 w[3] = {from_start.a, b, corner_on_grid(triangle, 2, fraction_bits_) - segment.from};
        std::uint64_t large = 0;
        for (const Integer3& v : {d, w[0], w[1], w[2]}) large |= shifted(v.x) | shifted(v.y) | shifted(v.z);

        if constexpr (has_native_int128)  // without it, small code is preferred
            if (large < near_span) return try_likely(from_start, d, w);
        if (crosses_face(from_start, d, w)) return;
        try_end(from_start, 0.0f);
        from_start.a = w[0] - d;
        try_end(from_start, 1.0f);
        try_sides<Int128, WideDifference>(from_start, d, w);
    }

    /// Between an end of the segment, from which the triangle is seen, and the triangle. Of ends that are as near, the
    /// first counts.
    ESPALIER_NOINLINE void try_end(const OriginRelative& triangle, float along) {
        const PointDistance distance = distance_to(triangle, fraction_bits_);
        if (radius_ >= 0.0f && is_within_radius(distance, fraction_bits_, radius_)) within_ = true;
        if (distance.squared < nearest_.squared || (along == 0.0f && distance.squared == nearest_.squared))
            nearest_ = {distance.squared, along, distance.u, distance.v, distance.feature};
    }

    /// Between the inside of a side and that of the segment: (w . (d x e))^2 / |d x e|^2.
    template <class Dot, class Difference>
    ESPALIER_NOINLINE void try_side(const Integer3& w, Argument<Dot> wd, const Integer3& e, const Integer3& d,
                                    Argument<Dot> length, int number) {
        const Dot ee = dot<Dot>(e, e);
        const Dot de = dot<Dot>(d, e);
        const Dot we = dot<Dot>(w, e);
        // The closest points of the two lines, along the segment and, in finer units, along the side.
        const Difference denominator = product_difference(length, ee, de, de);
        float along, share;
        if (!is_share(wd, ee, we, de, denominator, 0, along)) return;
        if (!is_share(wd, de, we, length, denominator, fraction_bits_, share)) return;
        const Int128 volume = magnitude(dot<Int128>(w, cross(d, e)));
        const float per_area = quotient(Difference(volume), denominator);
        const float squared = volume.is_zero() ? 0.0f : maximum(per_area * to_float(volume) * scale_, least_squared);
        offer(squared, along, number, share * power_of_two(-fraction_bits_), edge_of(number),
              [&](auto decide) { decide(Unsigned256::product(volume, volume), denominator); });
    }

private:
    /// With every coordinate of corners and segment in [-2^30, 2^30) int64 factors suffice.
    static constexpr std::uint64_t near_span = std::uint64_t{1} << 31;
    static std::uint64_t shifted(std::int64_t a) { return static_cast<std::uint64_t>(a) + near_span / 2; }

    /// try_all(), but for what floats rule out: first the end that is nearer to the plane.
    void try_likely(OriginRelative& from_start, const Integer3& d, const Integer3* w) {
        const PlacesInFloats likely(from_start, d, w, scale_);
        if (!likely.is_on_one_side() && crosses_face(from_start, d, w)) return;
        const bool second_first = likely.bound_of_end(true) < likely.bound_of_end(false);
        for (const bool is_second : {second_first, !second_first}) {
            if (likely.bound_of_end(is_second) > nearest_.squared * distance_slack) continue;
            from_start.a = is_second ? w[0] - d : w[0];
            try_end(from_start, is_second ? 1.0f : 0.0f);
        }
        try_sides<std::int64_t, Int128>(from_start, d, w, &likely);
    }

    /// Whether the segment leads through the face: its ends on different sides of the plane, and its line on the same
    /// side of all three sides. Where it only touches, or lies in the plane, the others find distance 0.
    ESPALIER_NOINLINE bool crosses_face(const OriginRelative& from_start, const Integer3& d, const Integer3* w) {
        const Integer3 normal = cross(from_start.ab, from_start.ac);
        const Int128 start = dot<Int128>(normal, from_start.a), end = dot<Int128>(normal, w[0] - d);
        if (start.is_zero() || end.is_zero() || start.is_negative() == end.is_negative()) return false;
        const Integer3& ab = from_start.ab;
        const Integer3& ac = from_start.ac;
        const bool back = start.is_negative();
        const Int128 weight_a = negate_if(dot<Int128>(w[1], cross(ac - ab, d)), back);
        const Int128 weight_b = negate_if(dot<Int128>(w[0], cross(d, ac)), back);
        const Int128 weight_c = negate_if(dot<Int128>(w[0], cross(ab, d)), back);
        if (weight_a.is_negative() || weight_b.is_negative() || weight_c.is_negative()) return false;
        const float whole = to_float(weight_a + weight_b + weight_c);
        nearest_ = {0.0f, to_float(magnitude(start)) / to_float(magnitude(start) + magnitude(end)),
                    to_float(weight_b) / whole, to_float(weight_c) / whole,
                    feature_of(weight_a.is_zero(), weight_b.is_zero(), weight_c.is_zero())};
        within_ = true;
        return true;
    }

    /// `w`: the corners, seen from the segment's start.
    template <class Dot, class Difference>
    ESPALIER_NOINLINE void try_sides(const OriginRelative& t, const Integer3& d, const Integer3* w,
                                     [[maybe_unused]] const PlacesInFloats* likely = nullptr) {
        const Dot length = dot<Dot>(d, d);
        for (int i = 0; i < 3; ++i) {
            const Dot along = dot<Dot>(w[i], d);
            try_corner<Dot, Difference>(w[i], along, length, i);
            if (takes_shortcut(likely != nullptr) && likely->rules_out_side(static_cast<unsigned>(i), fraction_bits_))
                continue;
            const Integer3 edge = i == 0 ? t.ab : i == 1 ? t.ac - t.ab : -t.ac;
            try_side<Dot, Difference>(w[i], along, edge, d, length, i);
        }
    }

    /// Between a corner and the inside of the segment: |w|^2 - (w . d)^2 / |d|^2.
    template <class Dot, class Difference>
    ESPALIER_NOINLINE void try_corner(const Integer3& w, Argument<Dot> along, Argument<Dot> length, int number) {
        if (!(Dot(0) < along && along < length)) return;
        const Difference numerator = product_difference(dot<Dot>(w, w), length, along, along);
        const Difference denominator(length);
        offer(quotient(numerator, denominator) * scale_, to_float(along) / to_float(length), number, 0.0f,
              vertex_of(number), [&](auto decide) { decide(Unsigned256(magnitude(numerator)), denominator); });
    }

    /// `share` is how far along side `number`. `visit_exact` passes the exact square to its argument.
    template <class VisitExact>
    void offer(float squared, float along, int number, float share, Feature feature, VisitExact visit_exact) {
        if (radius_ >= 0.0f && !within_) {
            visit_exact([&](const Unsigned256& numerator, const auto& denominator) {
                const Unsigned256 whole(magnitude(denominator));
                within_ = is_within_radius(numerator, {static_cast<std::int64_t>(whole.word[1]), whole.word[0]},
                                           fraction_bits_, radius_);
            });
        }
        if (squared < nearest_.squared)
            nearest_ = at_side(squared, minimum(along, 1.0f), number, minimum(share, 1.0f), feature);
    }

    int fraction_bits_;
    float radius_;  ///< negative if there is none
    float scale_;   ///< from squared units to squared lattice steps
    bool within_ = false;
    SegmentDistance nearest_ = {infinity, 0.0f, 0.0f, 0.0f, Feature::face};
};

}  // namespace espalier::detail
