// Claims about floats taken apart: each small function against the standard library's, which the runtime may not use.
#include "support/testing.hpp"

#include <runtime/base/bits.hpp>

namespace espalier::tests::float_bits_test {
namespace {

std::uint32_t bits_of(float value) { return std::bit_cast<std::uint32_t>(value); }

float any_float(Random& random) {
    if (random.below(8) == 0) return hostile_values[random.below(hostile_values.size())];
    return std::bit_cast<float>(static_cast<std::uint32_t>(random.next()));
}

TEST_CASE("numerics: scaling by a power of two equals ldexp for every float and exponent") {
    Random random(1);
    for (std::uint64_t i = 0; i < scaled(500'000); ++i) {
        const float x = any_float(random);
        if (std::isnan(x)) continue;
        const int exponent = random.below(16) == 0 ? random.between(-2000, 2000) : random.between(-300, 300);
        const float expected = std::ldexp(x, exponent);
        const float actual = detail::scale_by_power_of_two(x, exponent);
        CAPTURE(x);
        CAPTURE(exponent);
        REQUIRE(bits_of(actual) == bits_of(expected));
    }
}

TEST_CASE("numerics: rounding to an integer gives the nearest even one for every float below 2^24") {
    Random random(2);
    for (std::uint64_t i = 0; i < scaled(200'000); ++i) {
        float x = std::ldexp(random.signed_unit(), static_cast<int>(random.below(25)));
        if (random.below(4) == 0) x = static_cast<float>(random.between(-8'000'000, 8'000'000)) + 0.5f;
        CAPTURE(x);
        REQUIRE(detail::round_to_integer(x) == std::nearbyint(x));
    }
}

TEST_CASE("numerics: classification agrees with the standard library") {
    Random random(3);
    for (std::uint64_t i = 0; i < scaled(200'000); ++i) {
        const float x = any_float(random);
        REQUIRE(detail::is_nan(x) == std::isnan(x));
        REQUIRE(detail::is_finite(x) == std::isfinite(x));
        REQUIRE(detail::is_negative(x) == std::signbit(x));
        if (std::isnormal(x)) REQUIRE(detail::exponent_of(x) == std::ilogb(x));
        if (!std::isnan(x)) REQUIRE(detail::flush_subnormal(x) == (std::fpclassify(x) == FP_SUBNORMAL ? 0.0f : x));
    }
    for (int exponent = -126; exponent <= 127; ++exponent) {
        REQUIRE(detail::power_of_two(exponent) == std::ldexp(1.0f, exponent));
    }
}

TEST_CASE("numerics: the integer square root is correctly rounded") {
    Random random(4);
    for (std::uint64_t i = 0; i < scaled(200'000); ++i) {
        const float x = std::fabs(any_float(random));
        if (!std::isnormal(x) && x != 0.0f) continue;
        CAPTURE(x);
        REQUIRE(bits_of(detail::square_root_in_integers(x)) == bits_of(std::sqrt(x)));
        REQUIRE(bits_of(detail::square_root(x)) == bits_of(std::sqrt(x)));
    }
    for (std::uint32_t root = 1; root < 4097; ++root) {
        const auto square = static_cast<float>(root * root);
        REQUIRE(detail::square_root_in_integers(square) == static_cast<float>(root));
    }
}

TEST_CASE("numerics: numbers and fields are read low bits first at every alignment") {
    Random random(5);
    std::vector<std::byte> bytes(64);
    for (std::byte& b : bytes) b = static_cast<std::byte>(random.next());
    const auto bit = [&](std::size_t index) {
        return std::to_integer<std::uint32_t>(bytes[index / 8]) >> (index % 8) & 1u;
    };
    for (std::size_t at = 0; at < 8; ++at) {
        std::uint64_t expected = 0;
        for (unsigned i = 0; i < 64; ++i) expected |= std::uint64_t{bit(8 * at + i)} << i;
        CHECK(detail::load_u32(bytes.data() + at) == static_cast<std::uint32_t>(expected));
        CHECK(detail::load_u16(bytes.data() + at) == static_cast<std::uint16_t>(expected));
        CHECK(detail::load_i16(bytes.data() + at) == static_cast<std::int16_t>(expected));
        CHECK(detail::load_u8(bytes.data() + at) == static_cast<std::uint8_t>(expected));
    }
    for (unsigned width = 0; width <= 25; ++width) {
        for (unsigned index = 0; index < 16; ++index) {
            std::uint32_t expected = 0;
            for (unsigned i = 0; i < width; ++i) expected |= bit(std::size_t{width} * index + i) << i;
            REQUIRE(detail::load_field(bytes.data(), width, index) == expected);
        }
    }
}

}  // namespace
}  // namespace espalier::tests::float_bits_test
