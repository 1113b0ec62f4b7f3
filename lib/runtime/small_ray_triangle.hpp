// The kernel of ray_triangle.hpp for small cores: one width of integers for all triangles, and one function that all
// determinants go through. The same answers, bit for bit.
#pragma once

#include <bit>
#include <cstdint>

#include <runtime/ray_triangle.hpp>

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
[[gnu::noinline]] inline CrossProduct cross(const std::int32_t* q, const std::int32_t* r) {
    CrossProduct result;
    for (unsigned k = 0; k < 3; ++k) {
        const unsigned next = k == 2 ? 0 : k + 1;
        const unsigned last = k == 0 ? 2 : k - 1;
        result.coordinate[k] = std::int64_t{q[next]} * r[last] - std::int64_t{q[last]} * r[next];
    }
    return result;
}

/// For coordinates of p within 2^25.
[[gnu::noinline]] inline Words dot(const std::int32_t* p, const CrossProduct& q) {
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
[[gnu::noinline]] inline int compare_quotient(float quotient, const Words& numerator, const Words& denominator,
                                              int shift, float bound) {
    constexpr float slack = 1.0f + 0x1p-20f;
    if (quotient * slack < bound) return -1;
    if (bound * slack < quotient) return 1;
    if (bound == 0.0f) return 0;  // as the numerator is
    const std::uint32_t mantissa = (magnitude_bits(bound) & 0x007FFFFFu) | 0x00800000u;
    std::uint32_t left[4] = {numerator.word[0], numerator.word[1], numerator.word[2], 0};
    std::uint32_t right[4];
    std::uint64_t product = 0;
    for (unsigned i = 0; i < 3; ++i) {
        product += std::uint64_t{denominator.word[i]} * mantissa;
        right[i] = static_cast<std::uint32_t>(product);
        product >>= 32;
    }
    right[3] = static_cast<std::uint32_t>(product);
    // What is shifted becomes as long as the other, below 2^108.
    int exponent = exponent_of(bound) - 23 + shift;
    std::uint32_t* const shifted = exponent < 0 ? left : right;
    for (exponent = exponent < 0 ? -exponent : exponent; exponent != 0; --exponent)
        for (unsigned i = 3;; --i) {
            shifted[i] <<= 1;
            if (i == 0) break;
            shifted[i] |= shifted[i - 1] >> 31;
        }
    for (unsigned i = 3;; --i) {
        if (left[i] != right[i]) return left[i] < right[i] ? -1 : 1;
        if (i == 0) return 0;
    }
}

/// Whether the ray hits the triangle with ray.tau_min <= tau <= ray.tau_max, exactly. With all corners counted from the
/// origin in units of 2^-f, as they are given, each determinant of two of them and the direction is a corner's weight,
/// times 2^f, and that of all three is tau, times the sum of the weights and 2^f. Corners b and c become sides.
[[gnu::always_inline]] inline bool hits(const RoundedRay& ray, LatticeTriangle& from_origin, TriangleHit& hit) {
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
    if (ray.faces == (front ? Faces::back : Faces::front)) return false;
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
    hit.volume = volume.to_float();
    hit.tau = numerator.to_float() / hit.volume * power_of_two(-ray.fraction_bits);
    hit.whole_tau = ray.tau_offset + hit.tau;
    return compare_quotient(hit.tau, numerator, volume, ray.fraction_bits, ray.tau_min) >= 0 &&
           compare_quotient(hit.tau, numerator, volume, ray.fraction_bits, ray.tau_max) <= 0;
}

}  // namespace espalier::detail::small_ray_triangle
