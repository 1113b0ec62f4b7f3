// The kernel of ray_triangle.hpp for small cores: one width of integers for all triangles, and one function that all
// determinants go through. The same answers, bit for bit.
#pragma once

#include <cstdint>

#include <runtime/ray_triangle.hpp>

namespace espalier::detail::small_ray_triangle {

/// A signed integer of 96 bits, low words first.
struct Words {
    std::uint32_t word[3];

    [[nodiscard]] bool is_negative() const { return static_cast<std::int32_t>(word[2]) < 0; }
    [[nodiscard]] bool is_zero() const { return (word[0] | word[1] | word[2]) == 0; }
    [[nodiscard]] float to_float() const { return words_to_float(word, 3); }
    void negate() {
        std::uint32_t carry = 1;
        for (std::uint32_t& each : word) {
            each = ~each + carry;
            carry &= each == 0 ? 1u : 0u;
        }
    }
    void add(const Words& other) {
        std::uint64_t sum = 0;
        for (unsigned i = 0; i < 3; ++i) {
            sum += std::uint64_t{word[i]} + other.word[i];
            word[i] = static_cast<std::uint32_t>(sum);
            sum >>= 32;
        }
    }
};

/// p . (q x r), for coordinates within 2^25.
[[gnu::noinline]] inline Words triple_product(const std::int32_t* p, const std::int32_t* q, const std::int32_t* r) {
    // Of each coordinate of the cross product, below 2^51, the low word and the rest are multiplied apart: neither sum
    // of three fills its word.
    std::int64_t low = 0, high = 0;
    for (unsigned k = 0; k < 3; ++k) {
        const unsigned next = k == 2 ? 0 : k + 1;
        const unsigned last = k == 0 ? 2 : k - 1;
        const std::int64_t cross = std::int64_t{q[next]} * r[last] - std::int64_t{q[last]} * r[next];
        low += std::int64_t{static_cast<std::uint32_t>(cross)} * p[k];
        high += std::int64_t{static_cast<std::int32_t>(cross >> 32)} * p[k];
    }
    high += low >> 32;
    return {
        {static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(high), static_cast<std::uint32_t>(high >> 32)}};
}

/// Sign of numerator * 2^-shift / denominator - bound, exactly, for quotients that are nearly the bound.
[[gnu::noinline]] inline int compare_quotient(const Words& numerator, const Words& denominator, int shift,
                                              float bound) {
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
/// origin in units of 2^-f, each determinant of two of them and the direction is a corner's weight, times 2^f, and that
/// of all three is tau, times the sum of the weights and 2^f.
[[gnu::always_inline]] inline bool hits(const LatticeRay& ray, LatticeTriangle& triangle, TriangleHit& hit) {
    auto& c = triangle.corner;
    for (auto& corner : c)
        for (unsigned k = 0; k < 3; ++k) corner[k] = (corner[k] << ray.fraction_bits) - ray.origin[k];
    float weights[3];
    Words sum = {{0, 0, 0}};
    for (unsigned i = 0; i < 3; ++i) {
        const Words weight = triple_product(ray.direction, c[i == 2 ? 0 : i + 1], c[i == 0 ? 2 : i - 1]);
        sum.add(weight);
        weights[i] = weight.to_float();
    }
    const bool front = sum.is_negative();
    if (sum.is_zero() || (ray.faces == Faces::front && !front) || (ray.faces == Faces::back && front)) return false;
    for (float& weight : weights) {
        if (front) weight = -weight;
        if (weight < 0.0f) return false;
    }
    Words numerator = triple_product(c[0], c[1], c[2]);
    if (front) {
        sum.negate();
        numerator.negate();
    }
    if (numerator.is_negative()) return false;
    hit.volume = sum.to_float();
    hit.b = weights[1] + 0.0f;  // never -0
    hit.c = weights[2] + 0.0f;
    hit.tau = numerator.to_float() / hit.volume * power_of_two(-ray.fraction_bits);
    hit.whole_tau = ray.tau_offset + hit.tau;
    for (unsigned k = 0; k < 3; ++k) {  // corners become sides
        c[1][k] = (c[1][k] - c[0][k]) >> ray.fraction_bits;
        c[2][k] = (c[2][k] - c[0][k]) >> ray.fraction_bits;
    }
    for (unsigned k = 0; k < 3; ++k) {
        const std::int32_t along_axis[3] = {k == 0, k == 1, k == 2};
        hit.normal[k] = triple_product(along_axis, c[1], c[2]).to_float();
    }
    return ray_triangle::is_within(hit.tau, ray.tau_min, ray.tau_max, [&](float bound) {
        if (bound == 0.0f) return numerator.is_zero() ? 0 : 1;
        return compare_quotient(numerator, sum, ray.fraction_bits, bound);
    });
}

}  // namespace espalier::detail::small_ray_triangle
