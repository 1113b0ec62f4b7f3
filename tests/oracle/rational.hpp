// Fractions of whole numbers, exact, as a scalar for Eigen.
#pragma once

#include <compare>
#include <cstdint>
#include <ostream>
#include <string>

#include <Eigen/Core>

#include "big_integer.hpp"

namespace espalier::oracle {

/// Always in lowest terms, the denominator positive.
class Rational {
public:
    Rational() : denominator_(1) {}
    Rational(std::int64_t value) : numerator_(value), denominator_(1) {}  // NOLINT(google-explicit-constructor)
    Rational(int value) : Rational(std::int64_t{value}) {}                // NOLINT(google-explicit-constructor)
    /// Throws std::domain_error when the denominator is zero.
    Rational(const BigInteger& numerator, const BigInteger& denominator);

    /// Exactly the float. Throws std::domain_error for infinities and NaN.
    static Rational of(float value);
    /// Exactly value * 2^exponent.
    static Rational of(std::int64_t value, int exponent);

    [[nodiscard]] const BigInteger& numerator() const { return numerator_; }
    [[nodiscard]] const BigInteger& denominator() const { return denominator_; }
    [[nodiscard]] int sign() const { return numerator_.sign(); }
    /// The largest e with 2^e <= |this|. Throws std::domain_error for zero.
    [[nodiscard]] int exponent() const;
    [[nodiscard]] std::string to_string() const;

    Rational operator-() const;
    Rational& operator+=(const Rational& other) { return *this = *this + other; }
    Rational& operator-=(const Rational& other) { return *this = *this - other; }
    Rational& operator*=(const Rational& other) { return *this = *this * other; }
    Rational& operator/=(const Rational& other) { return *this = *this / other; }
    friend Rational operator+(const Rational& a, const Rational& b);
    friend Rational operator-(const Rational& a, const Rational& b) { return a + -b; }
    friend Rational operator*(const Rational& a, const Rational& b);
    friend Rational operator/(const Rational& a, const Rational& b);
    friend bool operator==(const Rational& a, const Rational& b) = default;  // lowest terms are unique
    friend std::strong_ordering operator<=>(const Rational& a, const Rational& b);

private:
    BigInteger numerator_;
    BigInteger denominator_;
};

inline std::ostream& operator<<(std::ostream& out, const Rational& a) { return out << a.to_string(); }

inline Rational absolute(const Rational& a) { return a.sign() < 0 ? -a : a; }

/// How far `value` is from `exact`, in units in the last place of a float of the exact value's size.
Rational error_in_ulp(float value, const Rational& exact);

}  // namespace espalier::oracle

namespace Eigen {

template <>
struct NumTraits<espalier::oracle::Rational> : GenericNumTraits<espalier::oracle::Rational> {
    using Rational = espalier::oracle::Rational;
    using Real = Rational;
    using NonInteger = Rational;
    using Nested = Rational;
    using Literal = Rational;
    enum {
        IsComplex = 0,
        IsInteger = 0,
        IsSigned = 1,
        RequireInitialization = 1,
        ReadCost = 64,
        AddCost = 500,
        MulCost = 1000
    };
    static Rational epsilon() { return 0; }
    static Rational dummy_precision() { return 0; }
    static int digits10() { return 0; }
};

}  // namespace Eigen
