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
    Rational() = default;
    Rational(std::int64_t value) : value_(static_cast<long>(value)) {}  // NOLINT(google-explicit-constructor)
    Rational(int value) : value_(value) {}                              // NOLINT(google-explicit-constructor)
    /// Throws std::domain_error when the denominator is zero.
    Rational(const BigInteger& numerator, const BigInteger& denominator);
    /// Exactly the float. Throws std::domain_error for infinities and NaN.
    static Rational of(float value);
    /// Exactly value * 2^exponent.
    static Rational of(std::int64_t value, int exponent);

    [[nodiscard]] BigInteger numerator() const { return BigInteger(value_.get_num()); }
    [[nodiscard]] BigInteger denominator() const { return BigInteger(value_.get_den()); }
    [[nodiscard]] int sign() const { return sgn(value_); }
    /// The largest e with 2^e <= |this|. Throws std::domain_error for zero.
    [[nodiscard]] int exponent() const;
    /// The largest whole number that is not above it.
    [[nodiscard]] Rational floor() const;
    /// To the next double toward zero.
    [[nodiscard]] double rounded() const { return value_.get_d(); }
    [[nodiscard]] std::string to_string() const { return value_.get_str(); }

    Rational operator-() const { return Rational(mpq_class(-value_)); }
    Rational& operator+=(const Rational& other) { return value_ += other.value_, *this; }
    Rational& operator-=(const Rational& other) { return value_ -= other.value_, *this; }
    Rational& operator*=(const Rational& other) { return value_ *= other.value_, *this; }
    Rational& operator/=(const Rational& other) { return *this = *this / other; }
    friend Rational operator+(const Rational& a, const Rational& b) { return Rational(mpq_class(a.value_ + b.value_)); }
    friend Rational operator-(const Rational& a, const Rational& b) { return Rational(mpq_class(a.value_ - b.value_)); }
    friend Rational operator*(const Rational& a, const Rational& b) { return Rational(mpq_class(a.value_ * b.value_)); }
    /// Throws std::domain_error for a division by zero.
    friend Rational operator/(const Rational& a, const Rational& b);
    friend bool operator==(const Rational& a, const Rational& b) { return a.value_ == b.value_; }
    friend std::strong_ordering operator<=>(const Rational& a, const Rational& b) {
        return cmp(a.value_, b.value_) <=> 0;
    }

private:
    explicit Rational(mpq_class value) : value_(std::move(value)) {}

    mpq_class value_;
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
