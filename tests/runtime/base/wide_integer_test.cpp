// Claims about the runtime's wide integers, against the oracle's, which know no width.
#include "support/testing.hpp"

#include <runtime/base/wide_integer.hpp>

#include "oracle/rational.hpp"

namespace espalier::tests::wide_integer_test {
namespace {

using detail::Int128;
using detail::Unsigned256;
using oracle::BigInteger;
using oracle::Rational;

BigInteger exact(Int128 value) { return BigInteger::of_words(value.high, value.low); }
BigInteger exact(const Unsigned256& value) {
    BigInteger result = 0;
    for (int i = 3; i >= 0; --i) result = result.shifted_left(64) + BigInteger::of_words(0, value.word[i]);
    return result;
}

/// Of every length, with long runs of ones and zeros more often than chance would have it.
std::uint64_t some_word(Random& random) {
    const auto kind = random.below(6);
    if (kind == 0) return 0;
    if (kind == 1) return ~std::uint64_t{0};
    if (kind == 2) return std::uint64_t{1} << random.below(64);
    if (kind == 3) return (std::uint64_t{1} << random.below(64)) - 1;
    return random.next() >> random.below(64);
}
std::int64_t some_signed(Random& random) { return static_cast<std::int64_t>(some_word(random)); }
/// Requires the nearest float, the even one of two. Returns whether there were two.
bool require_nearest(float value, const Rational& exact) {
    const Rational error = oracle::error_in_ulp(value, exact);
    REQUIRE(error <= Rational(1, 2));
    const bool is_tie = error == Rational(1, 2);
    if (is_tie) REQUIRE((std::bit_cast<std::uint32_t>(value) & 1u) == 0);
    return is_tie;
}

/// Below 2^126 in magnitude, so that sums stay inside.
Int128 some_wide(Random& random) { return {some_signed(random) >> 2, some_word(random)}; }

TEST_CASE("numerics: 128-bit sums and products and shifts and comparisons equal unbounded ones") {
    Random random(1);
    for (std::uint64_t i = 0; i < scaled(50'000); ++i) {
        const Int128 a = some_wide(random);
        const Int128 b = some_wide(random);
        REQUIRE(exact(a + b) == exact(a) + exact(b));
        REQUIRE(exact(a - b) == exact(a) - exact(b));
        REQUIRE(exact(-a) == -exact(a));
        REQUIRE((a < b) == (exact(a) < exact(b)));
        REQUIRE((a == b) == (exact(a) == exact(b)));
        REQUIRE(a.is_negative() == exact(a).is_negative());
        REQUIRE(a.is_zero() == exact(a).is_zero());
        const std::int64_t x = some_signed(random);
        const std::int64_t y = some_signed(random);
        REQUIRE(exact(detail::multiply(x, y)) == BigInteger(x) * BigInteger(y));
        REQUIRE(exact(Int128(x)) == BigInteger(x));
        const int shift = static_cast<int>(random.below(60));
        REQUIRE(exact(Int128(x) << shift) == BigInteger(x).shifted_left(shift));
    }
}

TEST_CASE("numerics: a 128-bit number converts to the nearest float and ties go to even") {
    Random random(2);
    std::uint64_t ties = 0;
    for (std::uint64_t i = 0; i < scaled(100'000); ++i) {
        Int128 a = some_wide(random);
        if (random.below(3) == 0) {  // 25 significant bits: half of them are ties
            a = Int128(static_cast<std::int64_t>(random.next() >> 39) | 1 << 24) << static_cast<int>(random.below(60));
            if (random.coin()) a = a << static_cast<int>(random.below(40));
            if (random.coin()) a = -a;
            if (random.below(4) == 0) a = a + Int128(1);
        }
        if (a.is_zero()) {
            REQUIRE(detail::to_float(a) == 0.0f);
            continue;
        }
        const float value = detail::to_float(a);
        const auto high = static_cast<std::uint64_t>(a.high);
        const std::uint32_t words[4] = {static_cast<std::uint32_t>(a.low), static_cast<std::uint32_t>(a.low >> 32),
                                        static_cast<std::uint32_t>(high), static_cast<std::uint32_t>(high >> 32)};
        REQUIRE(detail::words_to_float(words, 4) == value);
        CAPTURE(exact(a).to_string());
        ties += require_nearest(value, Rational(exact(a), 1)) ? 1u : 0u;
    }
    CHECK(ties > 0);
}

TEST_CASE("numerics: 256-bit products and shifts and lengths equal unbounded ones") {
    Random random(3);
    for (std::uint64_t i = 0; i < scaled(20'000); ++i) {
        const Int128 factor(some_signed(random), some_word(random));
        const Int128 other(some_signed(random), some_word(random));
        const Unsigned256 a(factor), b(other);
        REQUIRE(exact(Unsigned256::product(factor, other)) == exact(a) * exact(b));
        REQUIRE(a.bit_length() == exact(a).bit_length());
        const int shift = static_cast<int>(random.below(128));
        REQUIRE(exact(a.shifted_left(shift)) == exact(a).shifted_left(shift));
    }
}

TEST_CASE("numerics: 256-bit sums and differences equal unbounded ones and convert to the nearest float") {
    Random random(5);
    std::uint64_t ties = 0;
    for (std::uint64_t i = 0; i < scaled(20'000); ++i) {
        Unsigned256 a{Int128{}};
        for (std::uint64_t& word : a.word) word = some_word(random);
        a.word[3] >>= 1;
        if (random.coin()) {  // shorter, and often just between two floats
            const std::uint64_t half = some_word(random) >> 39 << 1 | 1u;
            a = Unsigned256(Int128(0, half)).shifted_left(static_cast<int>(random.below(200)));
            if (random.below(4) == 0) a = a.plus(Unsigned256(Int128(1)));
        }
        const Unsigned256 b =
            Unsigned256::product(Int128(some_signed(random) & 0xFFFF, some_word(random)), Int128(0, some_word(random)));
        REQUIRE(exact(a.plus(b)) == exact(a) + exact(b));
        REQUIRE(exact(a.plus(b).minus(b)) == exact(a));
        REQUIRE(exact(a.plus(b).minus(a)) == exact(b));
        const int exponent = random.between(-160, -130) + 256 - a.bit_length();
        const float value = detail::to_float(a, exponent);
        const Rational expected = Rational(exact(a), 1) * Rational::of(1, exponent);
        if (expected.sign() == 0) {
            REQUIRE(value == 0.0f);
            continue;
        }
        ties += require_nearest(value, expected) ? 1u : 0u;
    }
    CHECK(ties > 0);
}

TEST_CASE("numerics: a comparison with a scaled number is exact for every scale") {
    Random random(4);
    std::uint64_t equal = 0;
    for (std::uint64_t i = 0; i < scaled(50'000); ++i) {
        const auto some_unsigned = [&] {
            return Unsigned256::product(Int128(some_signed(random) & 0xFFFFFFFFFFFF, some_word(random)),
                                        Int128(0, some_word(random)));
        };
        Unsigned256 a = some_unsigned();
        Unsigned256 b = some_unsigned();
        int shift = random.between(-150, 150);
        if (random.below(3) == 0) {  // nearly the same number, written with two scales
            const int twist = static_cast<int>(random.below(60));
            b = Unsigned256(Int128(0, some_word(random)));
            a = b.shifted_left(twist);
            shift = twist;
            if (random.coin()) a.word[0] ^= 1;
            if (random.coin()) {
                std::swap(a, b);
                shift = -shift;
            }
        }
        const Rational right = Rational(exact(b), 1) * Rational::of(1, shift);
        const auto order = Rational(exact(a), 1) <=> right;
        const int expected = order < 0 ? -1 : order > 0 ? 1 : 0;
        REQUIRE(detail::compare_scaled(a, b, shift) == expected);
        if (expected == 0) ++equal;
    }
    CHECK(equal > 0);
}

}  // namespace
}  // namespace espalier::tests::wide_integer_test
