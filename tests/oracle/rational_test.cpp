// The oracle is only as good as its arithmetic: claims about what it adds to that of GMP.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include "rational.hpp"
#include "support/base/random.hpp"
#include "support/base/test_scale.hpp"

namespace espalier::tests::rational_test {
namespace {

using espalier::oracle::BigInteger;
using espalier::oracle::error_in_ulp;
using espalier::oracle::Rational;

/// A number of a random number of bits, both signs.
BigInteger some_integer(Random& random, int limbs) {
    BigInteger result = 0;
    for (int i = 0; i < limbs; ++i) {
        result =
            result.shifted_left(31) + BigInteger(static_cast<std::int64_t>(random.next() >> (33 + random.below(31))));
    }
    return random.coin() ? -result : result;
}

TEST_CASE("oracle: big integers shift and compare as those of the machine where it has enough bits") {
    Random random(1);
    for (std::uint64_t i = 0; i < scaled(20'000); ++i) {
        const auto a = static_cast<std::int32_t>(random.next() >> (32 + random.below(32)));
        const auto b = static_cast<std::int32_t>(random.next() >> (32 + random.below(32)));
        const auto shift = static_cast<int>(random.below(31));
        REQUIRE(BigInteger(a) - BigInteger(b) == BigInteger(std::int64_t{a} - b));
        REQUIRE((BigInteger(a) < BigInteger(b)) == (a < b));
        REQUIRE(BigInteger(a).shifted_left(shift) == BigInteger(std::int64_t{a} * (std::int64_t{1} << shift)));
        REQUIRE(BigInteger(a).bit_length() ==
                static_cast<int>(std::bit_width(std::uint64_t(std::abs(std::int64_t{a})))));
    }
    CHECK(BigInteger(std::numeric_limits<std::int64_t>::min()).to_string() == "-9223372036854775808");
}

TEST_CASE("oracle: rationals obey the laws of a field") {
    Random random(4);
    for (std::uint64_t i = 0; i < scaled(1'000); ++i) {
        const auto some = [&] {
            return Rational(some_integer(random, 3), some_integer(random, 3) + BigInteger(1).shifted_left(100));
        };
        const Rational a = some();
        const Rational b = some();
        const Rational c = some();
        REQUIRE((a + b) * c == a * c + b * c);
        REQUIRE((a - b) + b == a);
        if (b.sign() != 0) REQUIRE((a / b) * b == a);
        REQUIRE((a < b) == ((a - b).sign() < 0));
    }
    CHECK(Rational(6, 1) / Rational(-4, 1) == Rational(-3, 2));
    CHECK_THROWS_AS(Rational(1) / Rational(0), std::domain_error);
}

TEST_CASE("oracle: a float converts to exactly its rational value") {
    CHECK(Rational::of(0.0f) == Rational(0));
    CHECK(Rational::of(-1.5f) == Rational(-3, 2));
    CHECK(Rational::of(0x1p-149f) == Rational::of(1, -149));
    CHECK(Rational::of(0x1.fffffep127f) == Rational::of(0xFFFFFF, 104));
    CHECK_THROWS_AS(Rational::of(std::numeric_limits<float>::infinity()), std::domain_error);
    Random random(5);
    for (std::uint64_t i = 0; i < scaled(2'000); ++i) {
        const float a = random.signed_unit();
        const float b = random.signed_unit();
        // Sums and products of two 24-bit numbers of like size are exact in double.
        const Rational sum = Rational::of(a) + Rational::of(b);
        REQUIRE(sum ==
                Rational::of(static_cast<std::int64_t>(std::ldexp(static_cast<double>(a) + static_cast<double>(b), 40)),
                             -40));
        const Rational product = Rational::of(a) * Rational::of(b);
        REQUIRE(product ==
                Rational::of(static_cast<std::int64_t>(std::ldexp(static_cast<double>(a) * static_cast<double>(b), 60)),
                             -60));
    }
}

TEST_CASE("oracle: the error of a correctly rounded quotient is at most half an ulp") {
    Random random(6);
    Rational largest = 0;
    for (std::uint64_t i = 0; i < scaled(5'000); ++i) {
        const float a = random.signed_unit() + 2.0f;
        const float b = random.signed_unit() + 2.0f;
        const Rational error = error_in_ulp(a / b, Rational::of(a) / Rational::of(b));
        REQUIRE(error <= Rational(1, 2));
        largest = std::max(largest, error);
    }
    CHECK(largest > Rational(2, 5));
    CHECK(error_in_ulp(std::nextafter(1.0f, 2.0f), 1) == Rational(1));
    CHECK(error_in_ulp(std::nextafter(1.0f, 0.0f), 1) == Rational(1, 2));
}

}  // namespace
}  // namespace espalier::tests::rational_test
