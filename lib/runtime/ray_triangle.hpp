// Whether a rounded ray hits a triangle of the lattice: decided in integers, so that neighbours agree at every shared edge
// and vertex, on every machine. The division-free form with one origin-relative corner goes back to Möller and Trumbore (1997).
#pragma once

#include <cstdint>

#include <runtime/lattice_ray.hpp>
#include <runtime/wide_integer.hpp>

namespace espalier::detail {

/// Corners a, b, c in lattice steps.
struct LatticeTriangle {
    std::int32_t corner[3][3];
};

struct Integer3 {
    std::int64_t x, y, z;
};
inline Integer3 cross(const Integer3& a, const Integer3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// The sum in int64 where the caller knows that it fits, or in 128 bits.
template <class Sum>
Sum dot(const Integer3& a, const Integer3& b);
template <>
inline std::int64_t dot<std::int64_t>(const Integer3& a, const Integer3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <>
inline Int128 dot<Int128>(const Integer3& a, const Integer3& b) {
    return multiply(a.x, b.x) + multiply(a.y, b.y) + multiply(a.z, b.z);
}

/// A triangle as the kernels see it: corner a from the query's origin, in units of 2^-fraction_bits; edges in lattice steps.
struct OriginRelative {
    Integer3 a;
    Integer3 ab;
    Integer3 ac;
};

template <class Query>
inline OriginRelative relative_to(const Query& query, const LatticeTriangle& triangle) {
    const auto& c = triangle.corner;
    const auto from_origin = [&](int k) { return (std::int64_t{c[0][k]} << query.fraction_bits) - query.origin[k]; };
    const auto edge = [&](int to, int k) { return std::int64_t{c[to][k]} - c[0][k]; };
    return {{from_origin(0), from_origin(1), from_origin(2)},
            {edge(1, 0), edge(1, 1), edge(1, 2)},
            {edge(2, 0), edge(2, 1), edge(2, 2)}};
}

namespace ray_triangle {

/// Edges below 2^12 steps keep every determinant below 2^63: 24 bits of direction, 25 of corner, 12 of edge, 6 products.
inline bool is_small(const OriginRelative& t) {
    const auto shifted = [](std::int64_t e) { return static_cast<std::uint64_t>(e + 4096); };
    const std::uint64_t any = shifted(t.ab.x) | shifted(t.ab.y) | shifted(t.ab.z) | shifted(t.ac.x) | shifted(t.ac.y) |
                              shifted(t.ac.z);
    return any < 8192;
}

/// Sign of numerator / denominator - bound, exactly; numerator >= 0, denominator > 0, 0 < bound < infinity.
inline int compare_quotient(Int128 numerator, Int128 denominator, float bound) {
    const int exponent = exponent_of(bound) - 23;
    const auto mantissa = static_cast<std::int64_t>((magnitude_bits(bound) & 0x007FFFFFu) | 0x00800000u);
    return compare_scaled(Unsigned256(numerator),
                          Unsigned256::product(Unsigned256(denominator), Unsigned256(Int128(mantissa))), exponent);
}

/// Whether low <= numerator / denominator <= high, exactly, given the quotient as a float within 4 ulp.
inline bool is_within(Int128 numerator, Int128 denominator, float quotient, float low, float high) {
    constexpr float slack = 1.0f + 0x1p-20f;
    if (quotient * slack < low || high * slack < quotient) return false;
    if (low > 0.0f && quotient < low * slack && compare_quotient(numerator, denominator, low) < 0) return false;
    if (quotient * slack >= high) {
        if (high == 0.0f) return numerator.is_zero();
        return compare_quotient(numerator, denominator, high) <= 0;
    }
    return true;
}

template <class Sum>
inline bool hits(const LatticeRay& ray, const OriginRelative& t, float& tau) {
    const Integer3 direction = {ray.direction[0], ray.direction[1], ray.direction[2]};
    const Integer3 normal = cross(t.ab, t.ac);
    Sum denominator = dot<Sum>(direction, normal);
    const bool front = is_negative(denominator);
    if (is_zero(denominator) || (ray.faces == Faces::front && !front) || (ray.faces == Faces::back && front)) return false;
    Sum b = dot<Sum>(direction, cross(t.ac, t.a));
    Sum c = dot<Sum>(direction, cross(t.a, t.ab));
    Sum numerator = dot<Sum>(normal, t.a);
    if (front) {
        denominator = -denominator;
        b = -b;
        c = -c;
        numerator = -numerator;
    }
    if (is_negative(b) || is_negative(c) || is_negative(numerator)) return false;
    denominator = denominator << ray.fraction_bits;
    if (denominator < b + c) return false;
    tau = to_float(numerator) / to_float(denominator);
    return is_within(numerator, denominator, tau, ray.tau_min, ray.tau_max);
}

}  // namespace ray_triangle

/// Whether the ray hits the triangle with ray.tau_min <= tau <= tau_max, exactly; tau within 3 ulp.
inline bool intersect(const LatticeRay& ray, const LatticeTriangle& triangle, float& tau) {
    const OriginRelative t = relative_to(ray, triangle);
    return ray_triangle::is_small(t) ? ray_triangle::hits<std::int64_t>(ray, t, tau)
                                     : ray_triangle::hits<Int128>(ray, t, tau);
}

/// The rest of a hit: weights of corners b and c within 3 ulp, unit normal within 4 ulp.
struct HitSurface {
    float u;
    float v;
    Vec3 normal;
};
HitSurface surface_of_hit(const LatticeRay& ray, const LatticeTriangle& triangle) noexcept;

}  // namespace espalier::detail
