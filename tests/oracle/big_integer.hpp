// Whole numbers of any size: those of GMP, with the names that tests use.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <utility>

#include <gmpxx.h>

namespace espalier::oracle {

class BigInteger {
public:
    BigInteger() = default;
    BigInteger(std::int64_t value) : value_(static_cast<long>(value)) {  // NOLINT(google-explicit-constructor)
        static_assert(sizeof(long) == sizeof value);
    }
    explicit BigInteger(mpz_class value) : value_(std::move(value)) {}
    /// high * 2^64 + low.
    static BigInteger of_words(std::int64_t high, std::uint64_t low) {
        return BigInteger(high).shifted_left(64) + BigInteger(mpz_class(static_cast<unsigned long>(low)));
    }

    [[nodiscard]] const mpz_class& value() const { return value_; }
    [[nodiscard]] bool is_zero() const { return sign() == 0; }
    [[nodiscard]] bool is_negative() const { return sign() < 0; }
    /// -1, 0 or 1.
    [[nodiscard]] int sign() const { return sgn(value_); }
    /// Of the magnitude; 0 for zero.
    [[nodiscard]] int bit_length() const {
        return is_zero() ? 0 : static_cast<int>(mpz_sizeinbase(value_.get_mpz_t(), 2));
    }
    /// Decimal, for messages.
    [[nodiscard]] std::string to_string() const { return value_.get_str(); }

    BigInteger operator-() const { return BigInteger(mpz_class(-value_)); }
    /// Times a power of two.
    [[nodiscard]] BigInteger shifted_left(int bits) const {
        return BigInteger(mpz_class(value_ << static_cast<mp_bitcnt_t>(bits)));
    }

    friend BigInteger operator+(const BigInteger& a, const BigInteger& b) {
        return BigInteger(mpz_class(a.value_ + b.value_));
    }
    friend BigInteger operator-(const BigInteger& a, const BigInteger& b) {
        return BigInteger(mpz_class(a.value_ - b.value_));
    }
    friend BigInteger operator*(const BigInteger& a, const BigInteger& b) {
        return BigInteger(mpz_class(a.value_ * b.value_));
    }
    friend bool operator==(const BigInteger& a, const BigInteger& b) { return a.value_ == b.value_; }
    friend std::strong_ordering operator<=>(const BigInteger& a, const BigInteger& b) {
        return cmp(a.value_, b.value_) <=> 0;
    }

private:
    mpz_class value_;
};

}  // namespace espalier::oracle
