// How far a rounded point is from a triangle of the lattice. Squared distances are exact quotients of integers; which
// part of the triangle is closest is decided by exact signs. The regions are Ericson's (Real-Time Collision Detection,
// 2005, 5.1.5).
#pragma once

#include <cstdint>

#include <espalier/types.hpp>
#include <runtime/base/options.hpp>
#include <runtime/base/wide_integer.hpp>
#include <runtime/lattice/round_point.hpp>
#include <runtime/lattice/round_ray.hpp>
#include <runtime/lattice/triangle.hpp>

namespace espalier::detail {

/// A squared distance in lattice steps, exactly: numerator / denominator * 2^(-2 fraction_bits), or numerator^2 /
/// denominator for the distance to a face; and where on the triangle it is reached.
struct PointDistance {
    Int128 numerator;
    Int128 denominator;
    bool square_numerator;
    float squared;    ///< within 6 ulp
    float u, v;       ///< weights of corners b and c at the closest point
    Feature feature;  ///< which part of the triangle the closest point lies on, exactly
};

namespace point_triangle {

inline Int128 squared_length(const Integer3& a) { return dot<Int128>(a, a); }

/// Fills in the float value from the exact one.
inline void finish(PointDistance& distance, int fraction_bits) {
    const float numerator = to_float(distance.numerator);
    const float quotient = numerator / to_float(distance.denominator);
    distance.squared = (distance.square_numerator ? quotient * numerator : quotient) * power_of_two(-2 * fraction_bits);
}

/// Returns a squared distance to an edge or a vertex. Members are assigned one by one, because GCC zeroes a whole list
/// of values first, by a call.
ESPALIER_SHARED_CODE inline PointDistance squared_quotient(const Int128& numerator, const Int128& denominator,
                                                           Feature feature, int fraction_bits) {
    PointDistance result;
    result.numerator = numerator;
    result.denominator = denominator;
    result.square_numerator = false;
    result.u = 0.0f;
    result.v = 0.0f;
    result.feature = feature;
    finish(result, fraction_bits);
    return result;
}

/// A side and its ends.
struct Side {
    Feature edge, from, to;
};
inline constexpr Side side_ab = {Feature::edge_ab, Feature::vertex_a, Feature::vertex_b};
inline constexpr Side side_bc = {Feature::edge_bc, Feature::vertex_b, Feature::vertex_c};
inline constexpr Side side_ac = {Feature::edge_ca, Feature::vertex_a, Feature::vertex_c};

/// From a point to the segment a, a + edge; `p` is the point seen from a. `along` is how far along the edge, 0..1.
inline PointDistance to_segment(const Integer3& p, const Integer3& edge, int fraction_bits, const Side& side,
                                float& along) {
    const std::int64_t forward = dot<std::int64_t>(p, edge);
    const std::int64_t length = dot<std::int64_t>(edge, edge) << fraction_bits;
    const bool before = forward <= 0, after = forward >= length;
    along = before ? 0.0f : after ? 1.0f : to_float(forward) / to_float(length);
    const Integer3 apart = before ? p : after ? p - (edge << fraction_bits) : cross(p, edge);
    const bool at_end = before || after;
    return squared_quotient(squared_length(apart), at_end ? Int128(1) : Int128(length >> fraction_bits),
                            before  ? side.from
                            : after ? side.to
                                    : side.edge,
                            fraction_bits);
}

}  // namespace point_triangle

/// Where the weights of a point of the face are zero, it lies on a side; where two are, on a corner.
inline Feature feature_of(bool no_a, bool no_b, bool no_c) {
    if (no_c) return no_b ? Feature::vertex_a : no_a ? Feature::vertex_b : Feature::edge_ab;
    if (no_b) return no_a ? Feature::vertex_c : Feature::edge_ca;
    return no_a ? Feature::edge_bc : Feature::face;
}

/// Returns the smallest part of the triangle with some of its corners, one bit for each, of which at least one is set.
inline Feature feature_of_corners(unsigned corners) {
    return feature_of((corners & 1u) == 0, (corners & 2u) == 0, (corners & 4u) == 0);
}
/// Returns the corners of a part of the triangle, one bit for each.
inline unsigned corners_of(Feature part) {
    constexpr std::uint8_t corners[7] = {7, 3, 6, 5, 1, 2, 4};
    return corners[static_cast<unsigned>(part)];
}

/// The distance from the origin of `triangle` to it (also to one without area: then to its longest side).
PointDistance distance_to(const OriginRelative& triangle, int fraction_bits) noexcept;
inline PointDistance distance_to(const RoundedPoint& point, const LatticeTriangle& triangle) noexcept {
    count_decision();
    return distance_to(relative_to(point, triangle), point.fraction_bits);
}

/// Decides about a radius by a squared distance within 6 ulp. Returns 1 if the exact one is within the radius, -1 if
/// not, 0 if it may be either, which takes a radius above 0.
inline int sure_within(float squared, float radius) {
    const float bound = radius * radius;
    if (squared > bound * distance_slack) return -1;
    return squared * distance_slack < bound || squared == 0.0f ? 1 : 0;
}
/// Whether numerator / denominator * 2^(-2 fraction_bits) is at most the square of a radius above 0, exactly.
bool is_within_radius(const Unsigned256& numerator, const Int128& denominator, int fraction_bits,
                      float radius) noexcept;
/// Whether the distance is at most the radius (lattice steps, >= 0), exactly.
bool is_within_radius(const PointDistance& distance, int fraction_bits, float radius) noexcept;
inline bool is_within_radius(const RoundedPoint& point, const PointDistance& distance, float radius) noexcept {
    return is_within_radius(distance, point.fraction_bits, radius);
}

}  // namespace espalier::detail
