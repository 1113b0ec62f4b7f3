#include "rational.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace espalier::oracle {

Rational::Rational(const BigInteger& numerator, const BigInteger& denominator) {
    if (denominator.is_zero()) throw std::domain_error("Rational: division by zero");
    value_ = mpq_class(numerator.value(), denominator.value());
    value_.canonicalize();
}

Rational Rational::of(float value) {
    if (!std::isfinite(value)) throw std::domain_error("Rational: not a finite float");
    return Rational(mpq_class(static_cast<double>(value)));
}

Rational Rational::of(std::int64_t value, int exponent) {
    Rational result(value);
    const auto bits = static_cast<mp_bitcnt_t>(std::abs(exponent));
    (exponent >= 0 ? mpq_mul_2exp : mpq_div_2exp)(result.value_.get_mpq_t(), result.value_.get_mpq_t(), bits);
    return result;
}

int Rational::exponent() const {
    if (sign() == 0) throw std::domain_error("Rational: zero has no exponent");
    const int guess = numerator().bit_length() - denominator().bit_length();
    return absolute(*this) < of(1, guess) ? guess - 1 : guess;
}

Rational Rational::floor() const {
    mpz_class whole;
    mpz_fdiv_q(whole.get_mpz_t(), value_.get_num_mpz_t(), value_.get_den_mpz_t());
    return Rational(mpq_class(whole));
}

Rational operator/(const Rational& a, const Rational& b) {
    if (b.sign() == 0) throw std::domain_error("Rational: division by zero");
    return Rational(mpq_class(a.value_ / b.value_));
}

Rational error_in_ulp(float value, const Rational& exact) {
    const Rational error = absolute(Rational::of(value) - exact);
    if (error.sign() == 0) return 0;
    const int exponent = exact.sign() == 0 ? -126 : std::max(exact.exponent(), -126);
    return error / Rational::of(1, exponent - 23);
}

}  // namespace espalier::oracle
