// Sums of products of which each may be as wide as 254 bits, exactly: for signs that 128 bits do not hold.
#pragma once

#include <runtime/wide_integer.hpp>

namespace espalier::detail {

/// What is added up must stay below 2^256 in each sign. Out of line: rare where it matters.
class WideSum {
public:
    [[gnu::noinline]] void add_product(Argument<Int128> a, Argument<Int128> b) {
        const Unsigned256 product = Unsigned256::product(Unsigned256(negate_if(a, a.is_negative())),
                                                         Unsigned256(negate_if(b, b.is_negative())));
        Unsigned256& sum = of_sign_[a.is_negative() != b.is_negative() ? 1 : 0];
        sum = sum.plus(product);
    }
    /// -1, 0 or 1.
    [[nodiscard]] ESPALIER_SHARED_CODE int sign() const { return compare_scaled(of_sign_[0], of_sign_[1], 0); }
    /// The nearest float to the sum * 2^exponent, which must be zero or normal.
    [[nodiscard]] [[gnu::noinline]] float to_float(int exponent) const {
        return sign() < 0 ? -detail::to_float(of_sign_[1].minus(of_sign_[0]), exponent)
                          : detail::to_float(of_sign_[0].minus(of_sign_[1]), exponent);
    }
    /// Of the magnitude.
    [[nodiscard]] ESPALIER_SHARED_CODE Unsigned256 magnitude() const {
        return sign() < 0 ? of_sign_[1].minus(of_sign_[0]) : of_sign_[0].minus(of_sign_[1]);
    }

private:
    Unsigned256 of_sign_[2] = {Unsigned256(Int128{}), Unsigned256(Int128{})};  ///< the positive ones, the negative ones
};

}  // namespace espalier::detail
