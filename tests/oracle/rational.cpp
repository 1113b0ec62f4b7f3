#include "rational.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>

namespace espalier::oracle {

Rational::Rational(const BigInteger& numerator, const BigInteger& denominator)
    : numerator_(numerator), denominator_(denominator) {
    if (denominator_.is_zero()) throw std::domain_error("Rational: division by zero");
    if (denominator_.is_negative()) {
        numerator_ = -numerator_;
        denominator_ = -denominator_;
    }
    if (numerator_.is_zero()) {
        denominator_ = 1;
        return;
    }
    const int twos = std::min(numerator_.trailing_zeros(), denominator_.trailing_zeros());
    numerator_ = numerator_.shifted_right(twos);
    denominator_ = denominator_.shifted_right(twos);
    // Most denominators here are powers of two, and then nothing is left to cancel.
    if (denominator_.bit_length() == denominator_.trailing_zeros() + 1) return;
    const BigInteger divisor = greatest_common_divisor(numerator_, denominator_);
    if (divisor == BigInteger(1)) return;
    // Exact division by long division in binary: there is no remainder to care for.
    const auto divide = [&](const BigInteger& whole) {
        BigInteger rest = whole.is_negative() ? -whole : whole;
        BigInteger quotient;
        for (int shift = rest.bit_length() - divisor.bit_length(); shift >= 0; --shift) {
            const BigInteger part = divisor.shifted_left(shift);
            if (rest < part) continue;
            rest = rest - part;
            quotient = quotient + BigInteger(1).shifted_left(shift);
        }
        return whole.is_negative() ? -quotient : quotient;
    };
    numerator_ = divide(numerator_);
    denominator_ = divide(denominator_);
}

Rational Rational::of(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const auto biased = static_cast<int>(bits >> 23 & 255u);
    if (biased == 255) throw std::domain_error("Rational: not a finite float");
    const std::int64_t fraction = bits & 0x7FFFFFu;
    const std::int64_t mantissa = biased == 0 ? fraction : fraction | 0x800000;
    return of(bits >> 31 != 0 ? -mantissa : mantissa, (biased == 0 ? 1 : biased) - 150);
}

Rational Rational::of(std::int64_t value, int exponent) {
    const BigInteger whole(value);
    if (exponent >= 0) return {whole.shifted_left(exponent), 1};
    return {whole, BigInteger(1).shifted_left(-exponent)};
}

int Rational::exponent() const {
    if (sign() == 0) throw std::domain_error("Rational: zero has no exponent");
    const int guess = numerator_.bit_length() - denominator_.bit_length();
    return absolute(*this) < of(1, guess) ? guess - 1 : guess;
}

std::string Rational::to_string() const {
    std::string text = numerator_.to_string();
    if (denominator_ == BigInteger(1)) return text;
    text += '/';
    text += denominator_.to_string();
    return text;
}

Rational Rational::operator-() const {
    Rational result = *this;
    result.numerator_ = -numerator_;
    return result;
}

Rational operator+(const Rational& a, const Rational& b) {
    return {a.numerator_ * b.denominator_ + b.numerator_ * a.denominator_, a.denominator_ * b.denominator_};
}

Rational operator*(const Rational& a, const Rational& b) {
    return {a.numerator_ * b.numerator_, a.denominator_ * b.denominator_};
}

Rational operator/(const Rational& a, const Rational& b) {
    return {a.numerator_ * b.denominator_, a.denominator_ * b.numerator_};
}

std::strong_ordering operator<=>(const Rational& a, const Rational& b) {
    return a.numerator_ * b.denominator_ <=> b.numerator_ * a.denominator_;
}

Rational error_in_ulp(float value, const Rational& exact) {
    const Rational error = absolute(Rational::of(value) - exact);
    if (error.sign() == 0) return 0;
    const int exponent = exact.sign() == 0 ? -126 : std::max(exact.exponent(), -126);
    return error / Rational::of(1, exponent - 23);
}

}  // namespace espalier::oracle
