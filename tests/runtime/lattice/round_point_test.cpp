// Claims about the one rounding of a point and a radius.
#include "support/testing.hpp"

#include "support/exact/as_rationals.hpp"

namespace espalier::tests::round_point_test {
namespace {

using detail::RoundedPoint;

TEST_CASE("rounding: a point near the asset moves by at most half a 64th of a step and half an ulp") {
    Random random(1);
    for (std::uint64_t i = 0; i < scaled(5'000); ++i) {
        detail::BlobData data = tests::lattice_asset(1 + random.below(24));
        data.step_exponent = static_cast<std::int16_t>(random.between(-40, 20));
        const float size = std::ldexp(1.0f, data.step_exponent + data.bits);
        for (int k = 0; k < 3; ++k) data.origin[k] = random.signed_unit() * size * 8.0f;
        data.derive();
        const Vec3 offset = random.in_cube(std::ldexp(size, random.between(-3, 7)));
        const Vec3 world{data.origin[0] + offset.x, data.origin[1] + offset.y, data.origin[2] + offset.z};
        const float radius = random.unit() * size;
        RoundedPoint point;
        REQUIRE(detail::round_point(data, world, radius, point) == QueryStatus::ok);
        REQUIRE(point.distance_offset == 0.0f);
        REQUIRE(Rational::of(point.radius) == Rational::of(radius) * Rational::of(1, -data.step_exponent));
        const float given[3] = {world.x, world.y, world.z};
        for (int k = 0; k < 3; ++k) {
            const Rational exact =
                (Rational::of(given[k]) - Rational::of(data.origin[k])) * Rational::of(1, -data.step_exponent);
            const Rational rounded = Rational::of(point.origin[k], -point.fraction_bits);
            const Rational allowed =
                Rational::of(1, -point.fraction_bits - 1) + oracle::absolute(exact) * Rational::of(1, -24);
            REQUIRE(oracle::absolute(rounded - exact) <= allowed);
            REQUIRE(Rational::of(point.steps[k]) == rounded);
        }
    }
}

TEST_CASE("rounding: invalid points and radii are refused") {
    const detail::BlobData data = tests::lattice_asset(16);
    RoundedPoint point;
    const Vec3 good{1.0f, 2.0f, 3.0f};
    CHECK(detail::round_point(data, good, 0.0f, point) == QueryStatus::ok);
    CHECK(detail::round_point(data, good, -0.0f, point) == QueryStatus::ok);
    CHECK(detail::round_point(data, good, infinity, point) == QueryStatus::ok);
    CHECK(detail::round_point(data, good, not_a_number, point) == QueryStatus::invalid_argument);
    CHECK(detail::round_point(data, good, -1.0f, point) == QueryStatus::invalid_argument);
    CHECK(detail::round_point(data, good, -infinity, point) == QueryStatus::invalid_argument);
    for (const float bad : {not_a_number, infinity, -infinity}) {
        for (float Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
            Vec3 broken = good;
            broken.*axis = bad;
            CHECK(detail::round_point(data, broken, 1.0f, point) == QueryStatus::invalid_argument);
        }
    }
}

TEST_CASE("rounding: any point is refused or rounded below 2^37 steps") {
    Random random(2);
    std::uint64_t rounded = 0;
    for (std::uint64_t i = 0; i < scaled(100'000); ++i) {
        detail::BlobData data = tests::lattice_asset(1 + random.below(24));
        data.step_exponent = static_cast<std::int16_t>(random.between(-100, 100));
        data.derive();
        const auto any = [&] {
            return random.coin() ? tests::hostile_values[random.below(tests::hostile_values.size())]
                                 : std::bit_cast<float>(static_cast<std::uint32_t>(random.next()));
        };
        RoundedPoint point;
        if (detail::round_point(data, {any(), any(), any()}, any(), point) != QueryStatus::ok) continue;
        ++rounded;
        for (int k = 0; k < 3; ++k) {
            REQUIRE(std::abs(point.origin[k]) <= std::int64_t{1} << 37);
            REQUIRE(std::isfinite(point.steps[k]));
        }
        REQUIRE((point.fraction_bits >= 0 && point.fraction_bits <= 6));
        REQUIRE(point.radius >= 0.0f);
    }
    CHECK(rounded > scaled(100'000) / 100);
}

}  // namespace
}  // namespace espalier::tests::round_point_test
