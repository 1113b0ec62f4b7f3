// Whole numbers of up to 2,048 bits: plain schoolbook arithmetic, and an exception instead of a wrong digit.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <string>

namespace espalier::oracle {

class BigInteger {
public:
    BigInteger() = default;
    BigInteger(std::int64_t value);  // NOLINT(google-explicit-constructor): loses nothing

    [[nodiscard]] bool is_zero() const { return size_ == 0; }
    [[nodiscard]] bool is_negative() const { return negative_; }
    /// -1, 0 or 1.
    [[nodiscard]] int sign() const { return size_ == 0 ? 0 : negative_ ? -1 : 1; }
    /// Of the magnitude; 0 for zero.
    [[nodiscard]] int bit_length() const;
    /// How often 2 divides it; 0 for zero.
    [[nodiscard]] int trailing_zeros() const;
    /// Decimal, for messages.
    [[nodiscard]] std::string to_string() const;

    BigInteger operator-() const;
    /// Times or divided by a power of two; the division drops bits of the magnitude.
    [[nodiscard]] BigInteger shifted_left(int bits) const;
    [[nodiscard]] BigInteger shifted_right(int bits) const;

    friend BigInteger operator+(const BigInteger& a, const BigInteger& b);
    friend BigInteger operator-(const BigInteger& a, const BigInteger& b) { return a + -b; }
    friend BigInteger operator*(const BigInteger& a, const BigInteger& b);
    friend bool operator==(const BigInteger& a, const BigInteger& b) { return (a <=> b) == 0; }
    friend std::strong_ordering operator<=>(const BigInteger& a, const BigInteger& b);

private:
    static constexpr unsigned capacity = 64;

    void push(std::uint32_t limb);
    void trim();
    static int compare_magnitudes(const BigInteger& a, const BigInteger& b);
    static BigInteger add_magnitudes(const BigInteger& a, const BigInteger& b);
    static BigInteger subtract_magnitudes(const BigInteger& larger, const BigInteger& smaller);

    std::array<std::uint32_t, capacity> limbs_;  // the lowest first; those from size_ on hold nothing
    unsigned size_ = 0;
    bool negative_ = false;
};

/// The largest number that divides both; of magnitudes, 0 only for two zeros.
BigInteger greatest_common_divisor(BigInteger a, BigInteger b);

}  // namespace espalier::oracle
