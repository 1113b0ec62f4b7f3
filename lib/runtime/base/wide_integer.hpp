// Integers wide enough that no sign of a determinant on the lattice is ever guessed (docs/numerics.md has the widths).
#pragma once

#include <bit>
#include <cstdint>

#include <runtime/base/bits.hpp>
#include <runtime/base/options.hpp>

namespace espalier::detail {

inline constexpr bool has_native_int128 = ESPALIER_NATIVE_INT128 != 0;

/// Signed 128 bits in two's complement. Only what the kernels need.
struct Int128 {
    std::uint64_t low;
    std::int64_t high;

    constexpr Int128() = default;         // any number: what is computed is not zeroed first
    constexpr Int128(std::int64_t value)  // NOLINT(google-explicit-constructor): widening loses nothing
        : low(static_cast<std::uint64_t>(value)), high(value < 0 ? -1 : 0) {}
    constexpr Int128(std::int64_t high_word, std::uint64_t low_word) : low(low_word), high(high_word) {}

    [[nodiscard]] constexpr bool is_negative() const { return high < 0; }
    [[nodiscard]] constexpr bool is_zero() const { return (low | static_cast<std::uint64_t>(high)) == 0; }

    /// In place: takes no room on the stack for another sum.
    ESPALIER_SHARED_CODE constexpr void operator+=(const Int128& other) { add(other, *this); }
    constexpr void operator-=(const Int128& other) { *this += -other; }
    ESPALIER_SHARED_CODE friend constexpr Int128 operator+(const Int128& a, const Int128& b) {
        Int128 sum;
        a.add(b, sum);
        return sum;
    }
    ESPALIER_SHARED_CODE friend constexpr Int128 operator-(const Int128& a) {
#if ESPALIER_NATIVE_INT128
        return of(0 - native(a));
#else
        const std::uint64_t word = ~a.low + 1;
        return {static_cast<std::int64_t>(~static_cast<std::uint64_t>(a.high) + (word == 0 ? 1u : 0u)), word};
#endif
    }
    ESPALIER_SHARED_CODE friend constexpr Int128 operator-(const Int128& a, const Int128& b) {
        Int128 difference = -b;
        difference += a;
        return difference;
    }
    ESPALIER_SHARED_CODE friend constexpr bool operator<(const Int128& a, const Int128& b) {
        return a.high != b.high ? a.high < b.high : a.low < b.low;
    }
    friend constexpr bool operator==(const Int128& a, const Int128& b) { return a.low == b.low && a.high == b.high; }
    /// a * 2^shift, 0 <= shift < 64; the result must fit.
    ESPALIER_SHARED_CODE friend constexpr Int128 operator<<(const Int128& a, int shift) {
        if (shift == 0) return a;
        return {static_cast<std::int64_t>(static_cast<std::uint64_t>(a.high) << shift | a.low >> (64 - shift)),
                a.low << shift};
    }
    /// a / 2^shift, rounded down, 0 <= shift < 128.
    ESPALIER_SHARED_CODE friend constexpr Int128 operator>>(const Int128& a, int shift) {
        if (shift >= 64) return {a.high < 0 ? -1 : 0, static_cast<std::uint64_t>(a.high >> (shift - 64))};
        if (shift == 0) return a;
        return {a.high >> shift, static_cast<std::uint64_t>(a.high) << (64 - shift) | a.low >> shift};
    }

private:
#if ESPALIER_NATIVE_INT128
    static constexpr NativeUnsignedInt128 native(const Int128& a) {
        return static_cast<NativeUnsignedInt128>(static_cast<std::uint64_t>(a.high)) << 64 | a.low;
    }
    static constexpr Int128 of(NativeUnsignedInt128 a) {
        return {static_cast<std::int64_t>(a >> 64), static_cast<std::uint64_t>(a)};
    }
#endif
    ESPALIER_ALWAYS_INLINE constexpr void add(const Int128& other, Int128& sum) const {
#if ESPALIER_NATIVE_INT128
        sum = of(native(*this) + native(other));
#else
        const std::uint64_t low_word = low + other.low;
        const std::uint64_t carry = low_word < low ? 1 : 0;
        sum.high = static_cast<std::int64_t>(static_cast<std::uint64_t>(high) + static_cast<std::uint64_t>(other.high) +
                                             carry);
        sum.low = low_word;
#endif
    }
};

/// The full product of two words, neither of which has a sign.
constexpr Int128 multiply_words(std::uint64_t a, std::uint64_t b) {
#if ESPALIER_NATIVE_INT128
    const NativeUnsignedInt128 product = static_cast<NativeUnsignedInt128>(a) * b;
    return {static_cast<std::int64_t>(product >> 64), static_cast<std::uint64_t>(product)};
#else
    const std::uint64_t a0 = a & 0xFFFFFFFFu, a1 = a >> 32, b0 = b & 0xFFFFFFFFu, b1 = b >> 32;
    const std::uint64_t p00 = a0 * b0, p01 = a0 * b1, p10 = a1 * b0, p11 = a1 * b1;
    const std::uint64_t middle = (p00 >> 32) + (p01 & 0xFFFFFFFFu) + (p10 & 0xFFFFFFFFu);
    return {static_cast<std::int64_t>(p11 + (p01 >> 32) + (p10 >> 32) + (middle >> 32)),
            (p00 & 0xFFFFFFFFu) | middle << 32};
#endif
}

ESPALIER_SHARED_CODE constexpr Int128 multiply(std::int64_t a, std::int64_t b) {
#if ESPALIER_NATIVE_INT128
    const NativeInt128 product = static_cast<NativeInt128>(a) * b;
    return {static_cast<std::int64_t>(product >> 64), static_cast<std::uint64_t>(product)};
#else
    const auto first = static_cast<std::uint64_t>(a), second = static_cast<std::uint64_t>(b);
    Int128 product = multiply_words(first, second);
    const std::uint64_t excess = (a < 0 ? second : 0) + (b < 0 ? first : 0);
    product.high = static_cast<std::int64_t>(static_cast<std::uint64_t>(product.high) - excess);
    return product;
#endif
}

/// The product, which must fit.
ESPALIER_SHARED_CODE constexpr Int128 multiply(const Int128& a, std::int64_t b) {
    const Int128 low = multiply(static_cast<std::int64_t>(a.low), b);  // of the low word read as a signed one
    const std::uint64_t above = static_cast<std::uint64_t>(a.high) + (a.low >> 63);
    return {static_cast<std::int64_t>(static_cast<std::uint64_t>(low.high) + above * static_cast<std::uint64_t>(b)),
            low.low};
}

constexpr bool is_negative(const Int128& a) { return a.is_negative(); }
ESPALIER_SHARED_CODE constexpr Int128 negate_if(const Int128& a, bool condition) { return condition ? -a : a; }
constexpr std::int64_t magnitude(std::int64_t a) { return a < 0 ? -a : a; }
constexpr Int128 magnitude(const Int128& a) { return negate_if(a, a.is_negative()); }
constexpr bool is_zero(const Int128& a) { return a.is_zero(); }
/// -1, 0 or 1.
constexpr int sign(std::int64_t a) { return a < 0 ? -1 : a > 0 ? 1 : 0; }
ESPALIER_SHARED_CODE constexpr int sign(const Int128& a) { return a.is_negative() ? -1 : a.is_zero() ? 0 : 1; }

/// a * b - c * d, which must fit.
ESPALIER_SHARED_CODE constexpr Int128 product_difference(std::int64_t a, std::int64_t b, std::int64_t c,
                                                         std::int64_t d) {
    Int128 difference = multiply(a, b);
    difference -= multiply(c, d);
    return difference;
}

#if ESPALIER_NATIVE_INT128
/// The nearest float, ties to even.
ESPALIER_SHARED_CODE inline float to_float(const Int128& a) {
    if (a.high == (static_cast<std::int64_t>(a.low) < 0 ? -1 : 0)) return to_float(static_cast<std::int64_t>(a.low));
    const bool negative = a.is_negative();
    const Int128 m = negative ? -a : a;
    const std::uint64_t high = static_cast<std::uint64_t>(m.high);
    // The top 62 bits and more stand in one word; whatever is below only matters as "not zero".
    const int shift = 66 - std::countl_zero(high);  // high is not zero here, or low's top bit is set
    std::uint64_t top = shift >= 64 ? high >> (shift - 64) : high << (64 - shift) | m.low >> shift;
    const std::uint64_t rest = shift >= 64 ? m.low | (shift > 64 ? high << (128 - shift) : 0) : m.low << (64 - shift);
    if (rest != 0) top |= 1;
    const float value = static_cast<float>(static_cast<std::int64_t>(top)) *
                        std::bit_cast<float>(static_cast<std::uint32_t>(shift + 127) << 23);
    return negative ? -value : value;
}
#else
ESPALIER_SHARED_CODE inline float to_float(const Int128& a) {
    const auto high = static_cast<std::uint64_t>(a.high);
    const std::uint32_t words[4] = {static_cast<std::uint32_t>(a.low), static_cast<std::uint32_t>(a.low >> 32),
                                    static_cast<std::uint32_t>(high), static_cast<std::uint32_t>(high >> 32)};
    return words_to_float(words, 4);
}
#endif

/// Unsigned 256 bits, for comparing products of wide numbers.
struct Unsigned256 {
    std::uint64_t word[4];

    /// From a number that is not negative, or that is below 2^128.
    explicit constexpr Unsigned256(const Int128& a) : word{a.low, static_cast<std::uint64_t>(a.high), 0, 0} {}

    [[nodiscard]] ESPALIER_SHARED_CODE constexpr int bit_length() const {
        for (int i = 3; i >= 0; --i)
            if (word[i] != 0) return 64 * i + 64 - std::countl_zero(word[i]);
        return 0;
    }
    /// this * 2^shift, shift >= 0; the result must fit.
    [[nodiscard]] ESPALIER_SHARED_CODE constexpr Unsigned256 shifted_left(int shift) const {
        Unsigned256 result;
        const int words = shift / 64;
        const int bits = shift % 64;
        for (int i = 3; i >= 0; --i) {
            const std::uint64_t kept = i >= words ? word[i - words] << bits : 0;
            const std::uint64_t carried = bits != 0 && i > words ? word[i - words - 1] >> (64 - bits) : 0;
            result.word[i] = kept | carried;
        }
        return result;
    }
    /// The sum; it must fit.
    [[nodiscard]] ESPALIER_SHARED_CODE constexpr Unsigned256 plus(const Unsigned256& other) const {
        Unsigned256 result;
        std::uint64_t carry = 0;
        for (int i = 0; i < 4; ++i) {
            const std::uint64_t sum = word[i] + carry;
            result.word[i] = sum + other.word[i];
            carry = (sum < carry ? 1u : 0u) + (result.word[i] < sum ? 1u : 0u);
        }
        return result;
    }
    /// The difference, for an `other` that is not larger.
    [[nodiscard]] ESPALIER_SHARED_CODE constexpr Unsigned256 minus(const Unsigned256& other) const {
        Unsigned256 result;
        std::uint64_t borrow = 0;
        for (int i = 0; i < 4; ++i) {
            const std::uint64_t difference = word[i] - borrow;
            result.word[i] = difference - other.word[i];
            borrow = (word[i] < borrow ? 1u : 0u) + (difference < other.word[i] ? 1u : 0u);
        }
        return result;
    }
    /// The product of two numbers that are not negative, or that are below 2^128.
    ESPALIER_SHARED_CODE static constexpr Unsigned256 product(const Int128& a, const Int128& b) {
        Unsigned256 result;
        result.word[0] = result.word[1] = 0;
        for (int i = 0; i < 2; ++i) {
            const std::uint64_t factor = i == 0 ? a.low : static_cast<std::uint64_t>(a.high);
            std::uint64_t carry = 0;
            for (int j = 0; j < 2; ++j) {
                const Int128 product = multiply_words(factor, j == 0 ? b.low : static_cast<std::uint64_t>(b.high));
                const std::uint64_t low = product.low + carry;
                carry = static_cast<std::uint64_t>(product.high) + (low < carry ? 1 : 0);
                result.word[i + j] += low;
                carry += result.word[i + j] < low ? 1 : 0;
            }
            result.word[i + 2] = carry;
        }
        return result;
    }

private:
    constexpr Unsigned256() = default;  // uninitialised: each word is written once
};

/// The nearest float to a * 2^exponent, ties to even, which must be zero or normal.
ESPALIER_SHARED_CODE inline float to_float(const Unsigned256& a, int exponent) {
    const int length = a.bit_length();
    if (length <= 62) return to_float(static_cast<std::int64_t>(a.word[0])) * power_of_two(exponent);
    // The top 62 bits stand in one word; whatever is below only matters as "not zero".
    const int shift = length - 62;
    const int words = shift / 64;
    const int bits = shift % 64;
    std::uint64_t top = a.word[words] >> bits;
    if (bits > 2) top |= a.word[words + 1] << (64 - bits);
    std::uint64_t rest = bits == 0 ? 0 : a.word[words] << (64 - bits);
    for (int i = 0; i < words; ++i) rest |= a.word[i];
    if (rest != 0) top |= 1;
    return to_float(static_cast<std::int64_t>(top)) * power_of_two(shift + exponent);
}

/// Sign of a - b * 2^shift, for any a, b and shift: what is shifted becomes as long as the other.
ESPALIER_SHARED_CODE constexpr int compare_scaled(const Unsigned256& a, const Unsigned256& b, int shift) {
    const int a_length = a.bit_length();
    const int b_length = b.bit_length();
    if (a_length == 0 || b_length == 0) return a_length != 0 ? 1 : b_length != 0 ? -1 : 0;
    if (a_length != b_length + shift) return a_length > b_length + shift ? 1 : -1;
    const Unsigned256 left = shift < 0 ? a.shifted_left(-shift) : a;
    const Unsigned256 right = shift > 0 ? b.shifted_left(shift) : b;
    for (int i = 3; i >= 0; --i)
        if (left.word[i] != right.word[i]) return left.word[i] > right.word[i] ? 1 : -1;
    return 0;
}

}  // namespace espalier::detail
