// Boxes and triangles are closest at a side of the triangle, or where a corner of the box is nearest to the face; they
// cross at a side of the triangle, or where a diagonal of the box crosses the face. Widths: docs/numerics.md.
#include <runtime/kernels/triangle_distance.hpp>

namespace espalier::detail {

namespace {

/// A place on a side: its direction times numerator / denominator, in units of 2^-fraction_bits, from its start on.
struct Place {
    std::int64_t numerator;
    std::int64_t denominator;  ///< > 0

    [[nodiscard]] bool is_before(const Place& other) const {
        return numerator * other.denominator < other.numerator * denominator;
    }
};

/// A side of the triangle, against a box.
class SideAndBox {
public:
    /// `number`: 0 from corner a to b.
    SideAndBox(const UnitSegment& diagonal, const LatticeTriangle& triangle, int number)
        : box_(diagonal),
          bits_(diagonal.fraction_bits),
          side_(number),
          start_(corner_on_grid(triangle, number, bits_)),
          edge_(side_from(triangle, number)) {}

    /// The squared distance along the side is convex and smooth, and a parabola between the places where a coordinate
    /// enters or leaves the box: the signs of its slope there lead to the parabola with the minimum.
    PointDistance closest(float& along) const {
        Place low = {0, 1};
        Place high = {std::int64_t{1} << bits_, 1};
        along = 0.0f;
        if (!slope(low).is_negative()) return at_end(low, vertex_of(side_));
        along = 1.0f;
        if (!(Int128(0) < slope(high))) return at_end(high, vertex_of(side_ == 2 ? 0 : side_ + 1));
        for (int plane = 0; plane < 6; ++plane) {
            const int k = plane / 2;
            if (edge_[k] == 0) continue;
            const std::int64_t to_plane = (plane % 2 == 0 ? box_.from[k] : box_.to[k]) - start_[k];
            const bool backward = edge_[k] < 0;
            const Place place = {negate_if(to_plane, backward), negate_if(edge_[k], backward)};
            if (low.is_before(place) && place.is_before(high)) (slope(place).is_negative() ? low : high) = place;
        }
        // Coordinates that are in the box on all of the way from low to high do not count.
        const Integer3 from_low = gaps(low), from_high = gaps(high);
        Integer3 w, e;
        for (int k = 0; k < 3; ++k) {
            const std::int64_t gap = from_low[k] != 0 ? from_low[k] : from_high[k];
            w[k] = gap == 0 ? 0 : start_[k] - (gap < 0 ? box_.from[k] : box_.to[k]);
            e[k] = gap == 0 ? 0 : edge_[k];
        }
        const std::int64_t length = dot<std::int64_t>(e, e);  // not 0: the slope changes its sign
        along = minimum(-to_float(dot<std::int64_t>(w, e)) / to_float(length) * power_of_two(-bits_), 1.0f);
        return point_triangle::squared_quotient(point_triangle::squared_length(cross(w, e)), length, edge_of(side_),
                                                bits_);
    }

private:
    [[nodiscard]] PointDistance at_end(const Place& end, Feature feature) const {
        return point_triangle::squared_quotient(point_triangle::squared_length(gaps(end)), 1, feature, bits_);
    }
    /// How far the side's coordinates are beyond the box at a place, times the denominator: below 0 where too low.
    [[nodiscard]] Integer3 gaps(const Place& place) const {
        Integer3 gap;
        for (int k = 0; k < 3; ++k) {
            const std::int64_t at = start_[k] * place.denominator + edge_[k] * place.numerator;
            const std::int64_t below = at - box_.from[k] * place.denominator;
            const std::int64_t above = at - box_.to[k] * place.denominator;
            gap[k] = below < 0 ? below : above > 0 ? above : 0;
        }
        return gap;
    }
    /// Half the slope of the squared distance, times the denominator.
    [[nodiscard]] Int128 slope(const Place& place) const { return dot<Int128>(gaps(place), edge_); }

    const UnitSegment& box_;
    int bits_;
    int side_;
    Integer3 start_;
    Integer3 edge_;
};

/// Returns the distance of side `number`: 0 runs from a to b.
ESPALIER_SHARED_CODE PointDistance distance_of_side(const UnitSegment& diagonal, const LatticeTriangle& triangle,
                                                    int number, float& along) {
    return SideAndBox(diagonal, triangle, number).closest(along);
}

}  // namespace

UnitSegment diagonal_across(const UnitSegment& diagonal, const LatticeTriangle& triangle) noexcept {
    const Integer3 normal = normal_of(integer_triangle(triangle));
    UnitSegment across = diagonal;
    for (int k = 0; k < 3; ++k) {
        if (normal[k] >= 0) continue;
        across.from[k] = diagonal.to[k];
        across.to[k] = diagonal.from[k];
    }
    return across;
}

SegmentDistance distance_to_box(const UnitSegment& diagonal, const LatticeTriangle& triangle) noexcept {
    SegmentDistance nearest = distance_to(diagonal_across(diagonal, triangle), triangle);
    for (int i = 0; i < 3; ++i) {
        float along = 0.0f;
        const PointDistance side = distance_of_side(diagonal, triangle, i, along);
        if (side.squared < nearest.squared) nearest = at_side(side.squared, 0.0f, i, along, side.feature);
    }
    return nearest;
}

bool is_within_radius_of_box(const UnitSegment& diagonal, const LatticeTriangle& triangle,
                             const SegmentDistance& distance, float radius) noexcept {
    if (const int sure = sure_within(distance.squared, radius); sure != 0) return sure > 0;
    const UnitSegment across = diagonal_across(diagonal, triangle);
    bool within = is_within_radius(across, triangle, distance_to(across, triangle), radius);
    for (int i = 0; i < 3 && !within; ++i) {
        float along = 0.0f;
        within = is_within_radius(distance_of_side(diagonal, triangle, i, along), diagonal.fraction_bits, radius);
    }
    return within;
}

}  // namespace espalier::detail
