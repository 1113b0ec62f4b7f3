// Whether a rounded ray hits a triangle of the lattice: decided in integers, so that neighbours agree at every shared
// edge and vertex, on every machine. The division-free form with one origin-relative corner goes back to Möller and
// Trumbore (1997).
#pragma once

#include <bit>
#include <cstdint>

#include <runtime/base/bits.hpp>
#include <runtime/base/wide_integer.hpp>
#include <runtime/lattice/round_ray.hpp>
#include <runtime/lattice/triangle.hpp>

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
ESPALIER_NOINLINE inline int compare_quotient(Argument<Int128> numerator, Argument<Int128> denominator, float bound) {
    const int exponent = exponent_of(bound) - 23;
    const auto mantissa = static_cast<std::int64_t>((magnitude_bits(bound) & 0x007FFFFFu) | 0x00800000u);
    return compare_scaled(Unsigned256(numerator), Unsigned256::product(denominator, mantissa), exponent);
}

/// Returns whether a quotient lies in [low, high], exactly, given it as a float within 4 ulp; `compare` returns the
/// sign of the quotient less a bound.
template <class Compare>
inline bool is_within(float quotient, float low, float high, Compare compare) {
    constexpr float slack = 1.0f + 0x1p-20f;
    if (quotient * slack < low || high * slack < quotient) return false;
    if (low > 0.0f && quotient < low * slack && compare(low) < 0) return false;
    return quotient * slack < high || compare(high) <= 0;
}

/// False when the ray misses the triangle at every tau from 0 on, by signs alone; else what the callable returns, given
/// the side and the determinants. `Volume` holds the products of the normal with the direction and with corner a, `Sum`
/// the weights, which are larger. `Line` is an IntegerRay or what has its members.
template <class Volume, class Sum, class Line, class OnHit>
ESPALIER_ALWAYS_INLINE inline bool decide(const Line& ray, const OriginRelative& t, OnHit on_hit) {
    const Integer3 direction = {ray.direction[0], ray.direction[1], ray.direction[2]};
    const Integer3 normal = cross(t.ab, t.ac);
    Volume volume = dot<Volume>(direction, normal);
    const bool front = is_negative(volume);
    if (is_zero(volume) || (ray.culling == FaceCulling::back && !front) || (ray.culling == FaceCulling::front && front))
        return false;
    Sum b = dot<Sum>(direction, cross(t.ac, t.a));
    Sum c = dot<Sum>(direction, cross(t.a, t.ab));
    Volume numerator = dot<Volume>(normal, t.a);
    volume = negate_if(volume, front);
    b = negate_if(b, front);
    c = negate_if(c, front);
    numerator = negate_if(numerator, front);
    if (is_negative(b) || is_negative(c) || is_negative(numerator)) return false;
    const Sum denominator = Sum(volume) << ray.fraction_bits;
    Sum sum = b;
    sum += c;
    if (denominator < sum) return false;
    return on_hit(front, normal, volume, numerator, denominator, b, c);
}

/// Returns a volume above 0 with the sign that TriangleHit stores.
inline float with_side(float volume, bool front) {
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(volume) | (front ? 0u : ~magnitude_mask));
}

template <class Volume, class Sum>
inline bool hits(const IntegerRay& ray, const OriginRelative& t, TriangleHit& hit) {
    return decide<Volume, Sum>(
        ray, t,
        [&](bool front, const Integer3& normal, Volume volume, Volume numerator, Sum denominator, Sum b, Sum c) {
            const float divisor = to_float(volume) * power_of_two(ray.fraction_bits);
            hit.volume = with_side(divisor, front);
            hit.tau = to_float(numerator) / divisor;
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
    if constexpr (has_native_int128)  // without it, small code is preferred
        if (edges_are_below<middle_bits>(t)) return hits<std::int64_t, Int128>(ray, t, hit);
    return hits<Int128, Int128>(ray, t, hit);
}

/// Writes a hit that is not yet divided: t is the whole tau, the weights are times the volume, and the normal has any
/// length.
inline void set_undivided(RayHit& hit, const TriangleHit& found, std::uint32_t index) {
    hit.t = found.whole_tau;
    hit.u = found.b;
    hit.v = found.c;
    hit.normal = {found.normal[0], found.normal[1], found.normal[2]};
    hit.triangle = TriangleId{index};
}
/// Completes all but t: weights within 3 ulp, the unit normal's coordinates within 4 ulp of 1, the side exactly.
inline void divide_hit(RayHit& hit, float volume) {
    hit.u /= absolute(volume);
    hit.v /= absolute(volume);
    hit.normal = to_unit(hit.normal);
    hit.status = QueryStatus::ok;
    hit.side = static_cast<Side>(std::bit_cast<std::uint32_t>(volume) >> 31);
}
inline RayHit to_ray_hit(const TriangleHit& hit, std::uint32_t index) {
    RayHit result;
    set_undivided(result, hit, index);
    divide_hit(result, hit.volume);
    return result;
}

/// Returns a hit as the caller receives it: t within 4 ulp and in the ray's window.
template <class Caller>
inline RayHit to_ray_hit(const IntegerRay& rounded, const Caller& ray, const TriangleHit& hit, std::uint32_t index) {
    RayHit result = to_ray_hit(hit, index);
    result.t = to_t(rounded, hit.whole_tau, ray);
    return result;
}

/// Returns a hit that is none, with zeros for its numbers.
constexpr RayHit miss_of(float zero, QueryStatus status) {
    return {infinity, zero, zero, {zero, zero, zero}, no_triangle, status, Side::front, {}};
}
inline constexpr RayHit no_hit = miss_of(0.0f, QueryStatus::not_found);

/// Returns a hit that is none, with the reason.
inline RayHit miss_with(QueryStatus status) {
    // Small cores store word by word: a call to clear the rest, or a copy from a constant, takes more of them.
    if (!takes_shortcut()) return miss_of(std::bit_cast<float>(as_if_changed(0u)), status);
    // Others copy whole registers, which the caller's copy need not wait for. GCC would initialize field by field.
    RayHit miss;
    ESPALIER_COPY_BYTES(&miss, &no_hit, sizeof(miss));
    if (status != QueryStatus::not_found) miss.status = status;
    return miss;
}

}  // namespace espalier::detail
