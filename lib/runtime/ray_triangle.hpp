// Whether a rounded ray hits a triangle of the lattice: decided in integers, so that neighbours agree at every shared
// edge and vertex, on every machine. The division-free form with one origin-relative corner goes back to Möller and
// Trumbore (1997).
#pragma once

#include <cstdint>

#include <runtime/lattice_ray.hpp>
#include <runtime/lattice_triangle.hpp>
#include <runtime/square_root.hpp>
#include <runtime/wide_integer.hpp>

namespace espalier::detail {

namespace ray_triangle {

/// Whether every edge lies in [-2^k, 2^k) along every axis; k below 32.
template <unsigned k>
inline bool edges_are_below(const OriginRelative& t) {
    const auto shifted = [](std::int64_t e) { return static_cast<std::uint64_t>(e + (std::int64_t{1} << k)); };
    const std::uint64_t any =
        shifted(t.ab.x) | shifted(t.ab.y) | shifted(t.ab.z) | shifted(t.ac.x) | shifted(t.ac.y) | shifted(t.ac.z);
    return any < std::uint64_t{2} << k;
}

/// Sign of numerator / denominator - bound, exactly; numerator >= 0, denominator > 0, 0 < bound < infinity.
[[gnu::noinline]] inline int compare_quotient(Argument<Int128> numerator, Argument<Int128> denominator, float bound) {
    const int exponent = exponent_of(bound) - 23;
    const auto mantissa = static_cast<std::int64_t>((magnitude_bits(bound) & 0x007FFFFFu) | 0x00800000u);
    return compare_scaled(Unsigned256(numerator), Unsigned256::product(denominator, mantissa), exponent);
}

/// Whether a quotient lies in [low, high], exactly, given it as a float within 4 ulp; `compare` knows the sign of the
/// quotient less a bound.
template <class Compare>
inline bool is_within(float quotient, float low, float high, Compare compare) {
    constexpr float slack = 1.0f + 0x1p-20f;
    if (quotient * slack < low || high * slack < quotient) return false;
    if (low > 0.0f && quotient < low * slack && compare(low) < 0) return false;
    return quotient * slack < high || compare(high) <= 0;
}

/// False when the ray misses the triangle at every tau from 0 on, by signs alone; else what the callable returns, given
/// the determinants. `Volume` holds the products of the normal with the direction and with corner a, `Sum` the weights,
/// which are larger.
template <class Volume, class Sum, class OnHit>
[[gnu::always_inline]] inline bool decide(const IntegerRay& ray, const OriginRelative& t, OnHit on_hit) {
    const Integer3 direction = {ray.direction[0], ray.direction[1], ray.direction[2]};
    const Integer3 normal = cross(t.ab, t.ac);
    Volume volume = dot<Volume>(direction, normal);
    const bool front = is_negative(volume);
    if (is_zero(volume) || (ray.faces == Faces::front && !front) || (ray.faces == Faces::back && front)) return false;
    Sum b = dot<Sum>(direction, cross(t.ac, t.a));
    Sum c = dot<Sum>(direction, cross(t.a, t.ab));
    Volume numerator = dot<Volume>(normal, t.a);
    volume = negate_if(volume, front);
    b = negate_if(b, front);
    c = negate_if(c, front);
    numerator = negate_if(numerator, front);
    if (is_negative(b) || is_negative(c) || is_negative(numerator)) return false;
    const Sum denominator = Sum(volume) << ray.fraction_bits;
    if (denominator < b + c) return false;
    return on_hit(normal, volume, numerator, denominator, b, c);
}

template <class Volume, class Sum>
inline bool hits(const IntegerRay& ray, const OriginRelative& t, TriangleHit& hit) {
    return decide<Volume, Sum>(
        ray, t, [&](const Integer3& normal, Volume volume, Volume numerator, Sum denominator, Sum b, Sum c) {
            hit.volume = to_float(volume) * power_of_two(ray.fraction_bits);
            hit.tau = to_float(numerator) / hit.volume;
            hit.whole_tau = ray.tau_offset + hit.tau;
            hit.b = to_float(b);
            hit.c = to_float(c);
            hit.normal[0] = to_float(normal.x);
            hit.normal[1] = to_float(normal.y);
            hit.normal[2] = to_float(normal.z);
            return is_within(hit.tau, ray.tau_min, ray.tau_max, [&](float bound) {
                if (bound == 0.0f) return is_zero(numerator) ? 0 : 1;
                return compare_quotient(numerator, denominator, bound);
            });
        });
}
/// Whether the ray hits the triangle at any tau from 0 on.
template <class Volume, class Sum>
inline bool hits(const IntegerRay& ray, const OriginRelative& t) {
    return decide<Volume, Sum>(ray, t, [](const auto&...) { return true; });
}

/// Edges below 2^narrow_bits steps keep every determinant, and the sum of two that is formed of them, below 2^63; edges
/// below 2^middle_bits still those with the normal (docs/numerics.md).
inline constexpr unsigned narrow_bits = 12;
inline constexpr unsigned middle_bits = 18;

}  // namespace ray_triangle

/// Whether the ray hits the triangle with ray.tau_min <= tau <= ray.tau_max, exactly.
inline bool intersect(const IntegerRay& ray, const LatticeTriangle& triangle, TriangleHit& hit) {
    using namespace ray_triangle;
    const OriginRelative t = relative_to(ray, triangle);
    if (edges_are_below<narrow_bits>(t)) return hits<std::int64_t, std::int64_t>(ray, t, hit);
    if constexpr (has_native_int128)  // elsewhere code is dearer than time
        if (edges_are_below<middle_bits>(t)) return hits<std::int64_t, Int128>(ray, t, hit);
    return hits<Int128, Int128>(ray, t, hit);
}

/// A hit in the place where the caller sees it, but not yet divided: t is the whole tau, the weights are times the
/// volume, and the normal has any length.
inline RayHit undivided(const TriangleHit& hit, std::uint32_t index) {
    return {hit.whole_tau, hit.b, hit.c, {hit.normal[0], hit.normal[1], hit.normal[2]}, Triangle{index}};
}
/// What the caller sees of it but for t: weights within 3 ulp, the unit normal's coordinates within 4 ulp of 1.
inline void divide_hit(RayHit& hit, float volume) {
    const Vec3 n = hit.normal;
    const float length = square_root(n.x * n.x + n.y * n.y + n.z * n.z);
    hit.u /= volume;
    hit.v /= volume;
    hit.normal = {n.x / length, n.y / length, n.z / length};
}
inline RayHit to_ray_hit(const TriangleHit& hit, std::uint32_t index) {
    RayHit result = undivided(hit, index);
    divide_hit(result, hit.volume);
    return result;
}

/// All that the caller sees of a hit: t within 4 ulp and in the window that he asked for.
inline RayHit to_ray_hit(const IntegerRay& ray, const Ray& world, const TriangleHit& hit, std::uint32_t index) {
    RayHit result = to_ray_hit(hit, index);
    result.t = to_t(ray, hit.whole_tau, world);
    return result;
}

}  // namespace espalier::detail
