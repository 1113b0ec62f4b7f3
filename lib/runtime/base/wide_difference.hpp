// The difference of two products of 128-bit numbers, exactly: for signs and quotients that 128 bits do not hold.
#pragma once

#include <runtime/base/wide_integer.hpp>

namespace espalier::detail {

struct WideDifference {
    Unsigned256 magnitude;
    bool negative;

    WideDifference(const Unsigned256& from, bool is_below)
        : magnitude(from), negative(is_below && from.bit_length() != 0) {}
    explicit WideDifference(Argument<Int128> a) : WideDifference(Unsigned256(detail::magnitude(a)), a.is_negative()) {}

    [[nodiscard]] bool is_zero() const { return magnitude.bit_length() == 0; }
    [[nodiscard]] bool is_negative() const { return negative; }
    /// -1, 0 or 1.
    [[nodiscard]] int sign() const { return is_zero() ? 0 : negative ? -1 : 1; }
    /// The nearest float to it times 2^exponent, which must be zero or normal.
    [[nodiscard]] float to_float(int exponent) const {
        const float size = detail::to_float(magnitude, exponent);
        return negative ? -size : size;
    }
};
inline Unsigned256 magnitude(const WideDifference& a) { return a.magnitude; }

/// a * b - c * d; the sum of their magnitudes must stay below 2^256. Out of line: rare where it matters.
ESPALIER_NOINLINE inline WideDifference product_difference(const Int128& a, const Int128& b, const Int128& c,
                                                           const Int128& d) {
    const bool negative = a.is_negative() != b.is_negative();
    const bool subtracted_is_negative = c.is_negative() != d.is_negative();
    const Unsigned256 ab = Unsigned256::product(magnitude(a), magnitude(b));
    const Unsigned256 cd = Unsigned256::product(magnitude(c), magnitude(d));
    if (ab.bit_length() == 0) return {cd, !subtracted_is_negative};
    if (negative != subtracted_is_negative) return {ab.plus(cd), negative};
    const bool less = compare_scaled(ab, cd, 0) < 0;
    return {less ? cd.minus(ab) : ab.minus(cd), less != negative};
}
/// Its sign. Out of line: the difference does not lie on the caller's stack. Floats tell most signs in a fifth of the
/// time: each product is off by less than 2^-22 of itself, or by less than 2^-120 where that is subnormal.
ESPALIER_NOINLINE inline int compare_products(const Int128& a, const Int128& b, const Int128& c, const Int128& d) {
    if constexpr (!small_code) {
        const auto scaled = [](const Int128& factor) { return to_float(factor) * 0x1p-64f; };
        const float ab = scaled(a) * scaled(b), cd = scaled(c) * scaled(d);
        const float difference = ab - cd, error = (absolute(ab) + absolute(cd)) * 0x1p-20f + 0x1p-100f;
        if (absolute(difference) > error) return difference > 0.0f ? 1 : -1;
    }
    return product_difference(a, b, c, d).sign();
}

}  // namespace espalier::detail
