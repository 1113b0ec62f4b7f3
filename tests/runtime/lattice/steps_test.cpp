// Claims about going from the world to lattice steps and back: exactly rounded, for all floats and every lattice.
#include "support/testing.hpp"

#include <climits>

#include "oracle/rational.hpp"

namespace espalier::tests::steps_test {
namespace {

using oracle::Rational;

/// Subnormal ones count as zero.
float normal(float x) { return std::fpclassify(x) == FP_SUBNORMAL ? 0.0f : x; }

Rational exact_steps(float origin, float world, int step_exponent) {
    return (Rational::of(normal(world)) - Rational::of(normal(origin))) * Rational::of(1, -step_exponent);
}

bool is_in_range(const Rational& steps) { return oracle::absolute(steps) <= Rational(max_lattice_coordinate); }

struct Drawn {
    Lattice lattice;
    float low, high;  ///< two coordinates along every axis
};

/// Anything, or a few steps from the origin, or near a half of a step, or at the range's end.
float some_coordinate(Random& random, const Lattice& lattice) {
    const float origin = lattice.origin.x;
    const auto beside = [&](float steps) { return origin + std::ldexp(steps, lattice.step_exponent); };
    float x = 0.0f;
    const auto kind = random.below(6);
    if (kind == 0) x = std::bit_cast<float>(static_cast<std::uint32_t>(random.next()));
    else if (kind == 1) x = hostile_values[random.below(hostile_values.size())];
    else if (kind == 2) x = beside(static_cast<float>(random.between(-100, 100)) * 0.5f);
    else if (kind == 3) x = beside(std::ldexp(random.signed_unit(), random.between(-60, 30)));
    else if (kind == 4) x = random.coin() ? origin : -origin;
    else x = beside(random.coin() ? 0x1p29f : -0x1p29f);
    if (random.below(3) == 0) x = std::nextafter(x, random.coin() ? 1e38f : -1e38f);
    return x;
}

Drawn draw(Random& random) {
    Drawn drawn;
    const int exponent =
        random.coin() ? random.between(-24, 0) : random.between(format::min_step_exponent, format::max_step_exponent);
    float origin = std::ldexp(random.signed_unit(), random.between(-130, 127));
    if (random.coin()) origin = std::ldexp(random.signed_unit(), exponent + random.between(-10, 30));
    if (random.below(4) == 0) origin = 0.0f;
    origin = normal(std::isfinite(origin) ? origin : 0.0f);
    drawn.lattice = {{origin, origin, origin}, exponent, {1, 1, 1}};
    drawn.low = some_coordinate(random, drawn.lattice);
    drawn.high = random.below(3) == 0 ? drawn.low : some_coordinate(random, drawn.lattice);
    return drawn;
}

TEST_CASE("lattice: a point converts to the nearest lattice point and ties go up") {
    Random random(1);
    std::uint64_t rounded = 0, refused = 0, halves = 0;
    for (std::uint64_t i = 0; i < scaled(20'000); ++i) {
        const Drawn drawn = draw(random);
        const Lattice& lattice = drawn.lattice;
        const float x = drawn.low;
        CAPTURE(lattice.step_exponent);
        CAPTURE(lattice.origin.x);
        CAPTURE(x);
        const auto [steps, status] = to_lattice(lattice, Vec3{x, x, x});
        if (!std::isfinite(x)) {
            REQUIRE(status == QueryStatus::invalid_argument);
            continue;
        }
        const Rational place = exact_steps(lattice.origin.x, x, lattice.step_exponent) + Rational::of(1, -1);
        const Rational expected = place.floor();
        REQUIRE(status == (is_in_range(expected) ? QueryStatus::ok : QueryStatus::out_of_range));
        if (status != QueryStatus::ok) {
            ++refused;
            continue;
        }
        REQUIRE(Rational(std::int64_t{steps.x}) == expected);
        REQUIRE(steps == LatticePoint{steps.x, steps.x, steps.x});
        ++rounded;
        halves += place == expected && place.sign() != 0 ? 1u : 0u;
    }
    if (!asks_enough()) return;
    CHECK(rounded > 2'000);
    CHECK(refused > 1'000);
    CHECK(halves > 100);
}

TEST_CASE("lattice: a box converts to the smallest box in whole steps that holds it") {
    Random random(2);
    std::uint64_t rounded = 0, refused = 0, empty = 0;
    for (std::uint64_t i = 0; i < scaled(20'000); ++i) {
        const Drawn drawn = draw(random);
        const Lattice& lattice = drawn.lattice;
        const float low = drawn.low, high = drawn.high;
        CAPTURE(lattice.step_exponent);
        CAPTURE(lattice.origin.x);
        CAPTURE(low);
        CAPTURE(high);
        const auto [box, status] = to_lattice(lattice, Box{{low, low, low}, {high, high, high}});
        if (!std::isfinite(low) || !std::isfinite(high)) {
            REQUIRE(status == QueryStatus::invalid_argument);
            continue;
        }
        const Rational min = exact_steps(lattice.origin.x, low, lattice.step_exponent).floor();
        const Rational max = -(-exact_steps(lattice.origin.x, high, lattice.step_exponent)).floor();
        REQUIRE(status == (is_in_range(min) && is_in_range(max) ? QueryStatus::ok : QueryStatus::out_of_range));
        if (status != QueryStatus::ok) {
            ++refused;
            continue;
        }
        if (normal(low) > normal(high)) {
            REQUIRE(box.min.x > box.max.x);
            ++empty;
            continue;
        }
        REQUIRE(Rational(std::int64_t{box.min.x}) == min);
        REQUIRE(Rational(std::int64_t{box.max.z}) == max);
        ++rounded;
    }
    if (!asks_enough()) return;
    CHECK(rounded > 1'000);
    CHECK(refused > 1'000);
    CHECK(empty > 100);
}

TEST_CASE("lattice: a lattice point converts to its place within two roundings of the larger part") {
    Random random(3);
    for (std::uint64_t i = 0; i < scaled(5'000); ++i) {
        const Lattice lattice = draw(random).lattice;
        const auto number = static_cast<std::int32_t>(random.next()) >> random.below(32);
        CAPTURE(lattice.step_exponent);
        CAPTURE(lattice.origin.x);
        CAPTURE(number);
        const float world = to_local(lattice, {number, number, number}).x;
        if (!std::isfinite(world)) continue;
        const Rational part = Rational(std::int64_t{number}) * Rational::of(1, lattice.step_exponent);
        const Rational exact = Rational::of(lattice.origin.x) + part;
        const Rational larger = std::max(oracle::absolute(part), oracle::absolute(exact));
        REQUIRE(oracle::absolute(Rational::of(world) - exact) <= larger * Rational::of(1, -23) + Rational::of(1, -125));
    }
}

TEST_CASE("lattice: a lattice that no blob has is answered or refused without overflow") {
    const float endless = std::numeric_limits<float>::infinity();
    for (const std::int32_t exponent : {INT32_MIN, INT32_MIN + 1, -1000, -101, 101, 1000, INT32_MAX})
        for (const float origin : {0.0f, 1.0f, -1e30f, 1e-45f}) {
            const Lattice lattice = {{origin, origin, origin}, exponent, {1, 1, 1}};
            const Vec3 place = {1.0f, 2.0f, 3.0f};
            CHECK(to_lattice(lattice, place).status == QueryStatus::invalid_argument);
            CHECK(to_lattice(lattice, Box{place, place}).status == QueryStatus::invalid_argument);
            (void)to_local(lattice, {INT32_MIN, INT32_MAX, 1});
        }
    for (const float origin : {not_a_number, endless, -endless}) {
        const Lattice lattice = {{0.0f, origin, 0.0f}, 0, {1, 1, 1}};
        CHECK(to_lattice(lattice, Vec3{}).status == QueryStatus::invalid_argument);
        CHECK(to_lattice(lattice, Box{}).status == QueryStatus::invalid_argument);
    }
}

}  // namespace
}  // namespace espalier::tests::steps_test
