#include "big_integer.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>

namespace espalier::oracle {

BigInteger::BigInteger(std::int64_t value) : negative_(value < 0) {
    auto magnitude = static_cast<std::uint64_t>(value);
    if (negative_) magnitude = ~magnitude + 1;
    for (; magnitude != 0; magnitude >>= 32) push(static_cast<std::uint32_t>(magnitude));
}

void BigInteger::push(std::uint32_t limb) {
    if (size_ == capacity) throw std::overflow_error("BigInteger: more than 2048 bits");
    limbs_[size_++] = limb;
}

void BigInteger::trim() {
    while (size_ > 0 && limbs_[size_ - 1] == 0) --size_;
    if (size_ == 0) negative_ = false;
}

int BigInteger::bit_length() const {
    return size_ == 0 ? 0 : static_cast<int>(32 * size_) - std::countl_zero(limbs_[size_ - 1]);
}

int BigInteger::trailing_zeros() const {
    for (unsigned i = 0; i < size_; ++i) {
        if (limbs_[i] != 0) return static_cast<int>(32 * i) + std::countr_zero(limbs_[i]);
    }
    return 0;
}

std::string BigInteger::to_string() const {
    std::string digits;
    BigInteger rest = *this;
    while (rest.size_ > 0) {
        std::uint64_t remainder = 0;
        for (unsigned i = rest.size_; i-- > 0;) {
            const std::uint64_t part = remainder << 32 | rest.limbs_[i];
            rest.limbs_[i] = static_cast<std::uint32_t>(part / 10);
            remainder = part % 10;
        }
        rest.trim();
        digits += static_cast<char>('0' + remainder);
    }
    if (digits.empty()) return "0";
    if (negative_) digits += '-';
    std::reverse(digits.begin(), digits.end());
    return digits;
}

BigInteger BigInteger::operator-() const {
    BigInteger result = *this;
    result.negative_ = size_ > 0 && !negative_;
    return result;
}

BigInteger BigInteger::shifted_left(int bits) const {
    BigInteger result;
    if (size_ == 0) return result;
    for (int i = 0; i < bits / 32; ++i) result.push(0);
    std::uint32_t carry = 0;
    for (unsigned i = 0; i < size_; ++i) {
        const std::uint64_t wide = std::uint64_t{limbs_[i]} << (bits % 32) | carry;
        result.push(static_cast<std::uint32_t>(wide));
        carry = static_cast<std::uint32_t>(wide >> 32);
    }
    if (carry != 0) result.push(carry);
    result.negative_ = negative_;
    return result;
}

BigInteger BigInteger::shifted_right(int bits) const {
    BigInteger result;
    for (auto i = static_cast<unsigned>(bits / 32); i < size_; ++i) {
        const std::uint64_t next = i + 1 < size_ ? limbs_[i + 1] : 0;
        result.push(static_cast<std::uint32_t>((next << 32 | limbs_[i]) >> (bits % 32)));
    }
    result.negative_ = negative_;
    result.trim();
    return result;
}

int BigInteger::compare_magnitudes(const BigInteger& a, const BigInteger& b) {
    if (a.size_ != b.size_) return a.size_ < b.size_ ? -1 : 1;
    for (unsigned i = a.size_; i-- > 0;) {
        if (a.limbs_[i] != b.limbs_[i]) return a.limbs_[i] < b.limbs_[i] ? -1 : 1;
    }
    return 0;
}

BigInteger BigInteger::add_magnitudes(const BigInteger& a, const BigInteger& b) {
    BigInteger result;
    std::uint64_t carry = 0;
    for (unsigned i = 0; i < std::max(a.size_, b.size_); ++i) {
        carry += i < a.size_ ? a.limbs_[i] : 0u;
        carry += i < b.size_ ? b.limbs_[i] : 0u;
        result.push(static_cast<std::uint32_t>(carry));
        carry >>= 32;
    }
    if (carry != 0) result.push(static_cast<std::uint32_t>(carry));
    return result;
}

BigInteger BigInteger::subtract_magnitudes(const BigInteger& larger, const BigInteger& smaller) {
    BigInteger result;
    std::int64_t borrow = 0;
    for (unsigned i = 0; i < larger.size_; ++i) {
        std::int64_t digit = std::int64_t{larger.limbs_[i]} - borrow - (i < smaller.size_ ? smaller.limbs_[i] : 0u);
        borrow = digit < 0 ? 1 : 0;
        digit += borrow << 32;
        result.push(static_cast<std::uint32_t>(digit));
    }
    result.trim();
    return result;
}

BigInteger operator+(const BigInteger& a, const BigInteger& b) {
    BigInteger result;
    bool negative = a.negative_;
    if (a.negative_ == b.negative_) {
        result = BigInteger::add_magnitudes(a, b);
    } else if (BigInteger::compare_magnitudes(a, b) >= 0) {
        result = BigInteger::subtract_magnitudes(a, b);
    } else {
        result = BigInteger::subtract_magnitudes(b, a);
        negative = b.negative_;
    }
    result.negative_ = negative && result.size_ > 0;
    return result;
}

BigInteger operator*(const BigInteger& a, const BigInteger& b) {
    BigInteger result;
    for (unsigned i = 0; i < a.size_ + b.size_; ++i) result.push(0);
    for (unsigned i = 0; i < a.size_; ++i) {
        std::uint64_t carry = 0;
        for (unsigned j = 0; j < b.size_; ++j) {
            carry += std::uint64_t{a.limbs_[i]} * b.limbs_[j] + result.limbs_[i + j];
            result.limbs_[i + j] = static_cast<std::uint32_t>(carry);
            carry >>= 32;
        }
        result.limbs_[i + b.size_] = static_cast<std::uint32_t>(carry);
    }
    result.negative_ = a.negative_ != b.negative_;
    result.trim();
    return result;
}

std::strong_ordering operator<=>(const BigInteger& a, const BigInteger& b) {
    if (a.negative_ != b.negative_) return a.negative_ ? std::strong_ordering::less : std::strong_ordering::greater;
    const int order = BigInteger::compare_magnitudes(a, b);
    return (a.negative_ ? -order : order) <=> 0;
}

// Stein's way: only shifts and subtractions.
BigInteger greatest_common_divisor(BigInteger a, BigInteger b) {
    if (a.is_negative()) a = -a;
    if (b.is_negative()) b = -b;
    if (a.is_zero()) return b;
    if (b.is_zero()) return a;
    const int twos = std::min(a.trailing_zeros(), b.trailing_zeros());
    a = a.shifted_right(a.trailing_zeros());
    while (!b.is_zero()) {
        b = b.shifted_right(b.trailing_zeros());
        if (b < a) std::swap(a, b);
        b = b - a;
    }
    return a.shifted_left(twos);
}

}  // namespace espalier::oracle
