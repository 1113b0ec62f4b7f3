// The kernel of ray_triangle.hpp for small cores: one width of integers for all triangles, and one function that all
// determinants go through. The same answers, bit for bit.
#pragma once

#include <bit>
#include <cstdint>

#include <runtime/kernels/ray_triangle.hpp>

namespace espalier::detail::small_ray_triangle {

/// A signed integer of 96 bits, low words first.
struct Words {
    std::uint32_t word[3];

    [[nodiscard]] bool is_negative() const { return static_cast<std::int32_t>(word[2]) < 0; }
    [[nodiscard]] float to_float() const { return words_to_float(word, 3); }
};

/// A vector across two others.
struct CrossProduct {
    std::int64_t coordinate[3];  ///< below 2^51
};

/// For coordinates within 2^25.
ESPALIER_NOINLINE inline CrossProduct cross(const std::int32_t* q, const std::int32_t* r) {
    CrossProduct result;
    for (unsigned k = 0; k < 3; ++k) {
        const unsigned next = k == 2 ? 0 : k + 1;
        const unsigned last = k == 0 ? 2 : k - 1;
        result.coordinate[k] = std::int64_t{q[next]} * r[last] - std::int64_t{q[last]} * r[next];
    }
    return result;
}

/// For coordinates of p within 2^25.
ESPALIER_NOINLINE inline Words dot(const std::int32_t* p, const CrossProduct& q) {
    // The low word of each coordinate, as a signed one, and the rest are multiplied apart: neither sum of three fills
    // its word.
    std::int64_t low = 0, high = 0;
    for (unsigned k = 0; k < 3; ++k) {
        const auto low_word = static_cast<std::int32_t>(q.coordinate[k]);
        const std::int64_t rest = (q.coordinate[k] >> 32) - (low_word >> 31);
        low += std::int64_t{low_word} * p[k];
        high += std::int64_t{static_cast<std::int32_t>(rest)} * p[k];
    }
    high += low >> 32;
    return {
        {static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(high), static_cast<std::uint32_t>(high >> 32)}};
}

/// Sign of numerator * 2^-shift / denominator - bound, exactly, given the quotient as a float within 4 ulp.
ESPALIER_NOINLINE inline std::int32_t compare_quotient(float quotient, const Words& numerator, const Words& denominator,
                                                       int shift, float bound) {
    // Floats in the order of their bits, where negative ones count downwards.
    const auto bits = std::bit_cast<std::int32_t>(bound);
    const std::int32_t place = bits < 0 ? INT32_MIN - bits : bits;
    const std::int32_t order = std::bit_cast<std::int32_t>(quotient) - place;  // in ulp
    // A quotient is 0 or far from it: bounds of 0, or beside it, are decided by that.
    if (place <= 16 || static_cast<std::uint32_t>(order + 16) > 32) return order;
    int exponent = exponent_of(bound) - 23 + shift;
    Words left = numerator, right = denominator;
    std::uint32_t* const shifted = exponent < 0 ? left.word : right.word;
    for (exponent = exponent < 0 ? -exponent : exponent; exponent != 0; --exponent) {
        shifted[2] = shifted[2] << 1 | shifted[1] >> 31;
        shifted[1] = shifted[1] << 1 | shifted[0] >> 31;
        shifted[0] <<= 1;
    }
    // They are so close that their difference fits into 96 bits, though they may not.
    std::int64_t difference = 0;
    std::uint32_t any = 0;
    for (unsigned i = 0; i < 3; ++i) {
        difference += left.word[i];
        difference -= std::int64_t{right.word[i]} * ((bits & 0x007FFFFF) | 0x00800000);
        any |= static_cast<std::uint32_t>(difference);
        if (i == 2) break;
        difference >>= 32;
    }
    const auto top = static_cast<std::int32_t>(difference);
    return top != 0 ? top : any != 0;
}

/// Whether the ray hits the triangle with ray.tau_min <= tau <= ray.tau_max, exactly. With all corners counted from the
/// origin in units of 2^-f, as they are given, each determinant of two of them and the direction is a corner's weight,
/// times 2^f, and that of all three is tau, times the sum of the weights and 2^f. Corners b and c become sides.
ESPALIER_ALWAYS_INLINE inline bool hits(const IntegerRay& ray, LatticeTriangle& from_origin, TriangleHit& hit) {
    auto& c = from_origin.corner;
    std::int32_t negative = 0, positive = 0;  // below 0 where a weight is
    hit.c = 0.0f;
    const std::int32_t *q = c[1], *r = c[2];
    for (unsigned i = 0; i < 3; ++i) {
        const float weight = dot(ray.direction, cross(q, r)).to_float();
        negative |= std::bit_cast<std::int32_t>(weight);
        positive |= static_cast<std::int32_t>(0u - std::bit_cast<std::uint32_t>(weight));
        hit.b = hit.c;
        hit.c = absolute(weight);
        q = r;
        r = c[i];
    }
    if ((negative ^ positive) >= 0) return false;
    const bool front = negative < 0;
    if (ray.culling == (front ? FaceCulling::front : FaceCulling::back)) return false;
    for (unsigned k = 0; k < 3; ++k) {
        c[1][k] -= c[0][k];
        c[2][k] -= c[0][k];
        if (front) c[2][k] = -c[2][k];  // then the volume is positive
    }
    const CrossProduct normal = cross(c[1], c[2]);
    const Words volume = dot(ray.direction, normal);
    const Words numerator = dot(c[0], normal);
    if (numerator.is_negative()) return false;
    for (unsigned k = 0; k < 3; ++k) hit.normal[k] = to_float(front ? -normal.coordinate[k] : normal.coordinate[k]);
    const float divisor = volume.to_float();
    hit.volume = ray_triangle::with_side(divisor, front);
    hit.tau = numerator.to_float() / divisor * power_of_two(-ray.fraction_bits);
    hit.whole_tau = ray.tau_offset + hit.tau;
    return compare_quotient(hit.tau, numerator, volume, ray.fraction_bits, ray.tau_min) >= 0 &&
           compare_quotient(hit.tau, numerator, volume, ray.fraction_bits, ray.tau_max) <= 0;
}

}  // namespace espalier::detail::small_ray_triangle
