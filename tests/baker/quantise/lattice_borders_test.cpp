// Claims about the lattice at the borders of what it accepts: the functions that choose it, asked directly.
#include "support/testing.hpp"

#include <baker/base/float_rounding.hpp>
#include <baker/quantise/lattice.hpp>

#include "baker/baking_support.hpp"

namespace espalier::tests::lattice_borders_test {
namespace {

constexpr float least_normal = std::numeric_limits<float>::min();

/// Of a triangle with these two corners.
baker::SourceBounds bounds_between(Vec3 low, Vec3 high) {
    baker::Source source;
    source.positions = {baker::to_float64(low), baker::to_float64(high), baker::to_float64(low)};
    source.triangles = {{{0, 1, 2}, 0}};
    return baker::bounds_of(source);
}

double number_after(const std::string& text, const std::string& before) {
    const std::size_t at = text.find(before);
    REQUIRE(at != std::string::npos);
    return std::stod(text.substr(at + before.size()));
}

TEST_CASE("lattice: the largest side is the longest of the three wherever the box is") {
    CHECK(bounds_between({-3.0f, 10.0f, 20.0f}, {5.0f, 11.0f, 21.0f}).largest_side == 8.0);
    CHECK(bounds_between({10.0f, -3.0f, 20.0f}, {11.0f, 5.0f, 21.0f}).largest_side == 8.0);
    CHECK(bounds_between({10.0f, 20.0f, -3.0f}, {11.0f, 21.0f, 5.0f}).largest_side == 8.0);
    CHECK(bounds_between({10.0f, 20.0f, -3.0f}, {11.0f, 21.0f, 5.0f}).largest_coordinate == 21.0f);
    CHECK(bounds_between({-30.0f, 20.0f, -3.0f}, {11.0f, 21.0f, 5.0f}).largest_coordinate == 30.0f);
    CHECK(bounds_between({1.0f, -31.0f, -3.0f}, {11.0f, 21.0f, 5.0f}).largest_coordinate == 31.0f);
    CHECK(bounds_between({1.0f, 1.0f, -32.0f}, {11.0f, 21.0f, 5.0f}).largest_coordinate == 32.0f);
    CHECK(baker::bounds_of({}).largest_side == 0.0);
}

TEST_CASE("lattice: a coordinate snaps to the nearest multiple of the step and float32 holds it") {
    Random random(24);
    for (int i = 0; i < 100'000; ++i) {
        const int exponent = random.between(format::min_step_exponent, format::max_step_exponent);
        const double step = std::ldexp(1.0, exponent);
        float coordinate = std::bit_cast<float>(static_cast<std::uint32_t>(random.next()));
        if (random.coin()) coordinate = std::ldexp(random.signed_unit(), exponent + random.between(-5, 26));
        if (random.below(8) == 0) coordinate = static_cast<float>((random.between(-99, 99) + 0.5) * step);
        if (!std::isfinite(coordinate)) continue;
        CAPTURE(coordinate);
        CAPTURE(exponent);
        const double snapped = baker::snap_to_step(double(coordinate), 1.0 / step);
        REQUIRE(snapped == std::nearbyint(snapped));
        REQUIRE(!(snapped == 0.0 && std::signbit(snapped)));
        const double place = snapped * step;
        REQUIRE(double(static_cast<float>(place)) == place);
        const double moved = std::abs(double(coordinate) - place);
        REQUIRE(moved <= 0.5 * step);
        if (moved == 0.5 * step) REQUIRE(std::fmod(snapped, 2.0) == 0.0);
    }
    for (const float largest : {std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()})
        CHECK(baker::snap_to_step(double(largest), 0x1p-100) * 0x1p100 == double(largest));
    CHECK(!std::signbit(baker::snap_to_step(-0.0, 1.0)));
    CHECK(!std::signbit(baker::snap_to_step(double(-least_normal), 1.0)));
}

TEST_CASE("lattice: the origin is the lowest corner snapped to the step") {
    const auto bounds = bounds_between({-0.75f, 0.5f, 100.25f}, {1.0f, 3.0f, 101.0f});
    const auto lattice = baker::lattice_for_step(bounds, 0);
    REQUIRE(lattice);
    CHECK(lattice->origin == Vec3{-1.0f, 0.0f, 100.0f});
    CHECK(lattice->bits == 2);  // along y from 0 to 3
    CHECK(baker::lattice_for_step(bounds, -1)->origin == Vec3{-1.0f, 0.5f, 100.0f});
}

TEST_CASE("lattice: a step too fine for the meshes is refused with the finest that fits") {
    for (int exponent = -60; exponent <= 60; ++exponent) {
        const float most = std::ldexp(0x1p24f - 1.0f, exponent);
        const auto fits = bounds_between({}, {most, 0.0f, 0.0f});
        REQUIRE(baker::lattice_for_step(fits, exponent));
        CHECK(baker::lattice_for_step(fits, exponent)->bits == 24);
        const auto refused = baker::lattice_for_step(fits, exponent - 1);
        REQUIRE(!refused);
        CHECK(refused.refusal().status == BakeStatus::too_fine);
        CHECK(number_after(refused.refusal().message, "the finest step is 2^") == exponent);
        const auto larger = bounds_between({}, {std::ldexp(1.0f, exponent + 24), 0.0f, 0.0f});
        CHECK(!baker::lattice_for_step(larger, exponent));
    }
    CHECK(baker::lattice_for_step(baker::SourceBounds{}, -7)->step_exponent == -7);
}

TEST_CASE("lattice: a step finer than the spacing of the source floats is reported and only then") {
    const auto bounds = bounds_between({0.0f, 0.0f, 0.0f}, {1.5f, 1.0f, 1.0f});  // a spacing of 2^-23
    CHECK_FALSE(baker::is_below_float_spacing({{}, -23, 24}, bounds));
    CHECK(baker::is_below_float_spacing({{}, -24, 24}, bounds));
    CHECK_FALSE(baker::is_below_float_spacing({{}, -100, 24}, baker::SourceBounds{}));
}

TEST_CASE("lattice: the finest and the coarsest step of the format are used and the next are refused") {
    for (const unsigned bits : {1u, 8u, 24u}) {
        const auto of_exponent = [&](int exponent) {
            const float side =
                std::ldexp(1.0f, exponent + static_cast<int>(bits)) - std::ldexp(1.0f, exponent);  // 2^bits - 1 steps
            return baker::lattice_for_bits(bounds_between({}, {side, side, side}), bits);
        };
        for (const int border : {format::min_step_exponent, format::max_step_exponent}) {
            const auto kept = of_exponent(border);
            REQUIRE(kept);
            CHECK(kept->step_exponent == border);
            const auto refused = of_exponent(border < 0 ? border - 1 : border + 1);
            REQUIRE(!refused);
            CHECK(refused.refusal().status == BakeStatus::too_large);
        }
    }
}

TEST_CASE("lattice: a tolerance gives the coarsest step that keeps it also when it is just kept") {
    for (int exponent = -40; exponent <= 40; ++exponent) {
        const auto just = double(baker::round_up_to_float(0x1.bb67ae8584cabp-1 * std::ldexp(1.0, exponent)));
        CHECK(baker::step_exponent_for_tolerance(just) == exponent);
        CHECK(baker::step_exponent_for_tolerance(just * (1.0 - 0x1p-30)) == exponent - 1);
        CHECK(baker::step_exponent_for_tolerance(just * 1.99) == exponent);
    }
}

TEST_CASE("lattice: all of 24 bits are used and limits that a refusal names are accepted and tight") {
    for (int i = 0; i < 200; ++i) {
        const double tolerance = std::ldexp(0.001 + 0.0137 * i, i % 20 - 10);
        const int exponent = baker::step_exponent_for_tolerance(tolerance);
        const double most = (0x1p24 - 1.0) * std::ldexp(1.0, exponent);
        const auto fits = bounds_between({}, {static_cast<float>(most), 0.0f, 0.0f});
        const auto kept = baker::lattice_for_tolerance(fits, exponent, tolerance);
        REQUIRE(kept);
        CHECK(kept->bits == 24);
        CHECK(kept->step_exponent == exponent);
        const auto larger = bounds_between({}, {static_cast<float>(most * 1.5), 1.0f, 1.0f});
        const auto refused = baker::lattice_for_tolerance(larger, exponent, tolerance);
        REQUIRE(!refused);
        CHECK(refused.refusal().status == BakeStatus::too_fine);
        const double named = number_after(refused.refusal().message, "they may be ");
        CHECK(named <= most);
        CHECK(named >= most * (1.0 - 3e-8));
        const double finest = number_after(refused.refusal().message, "the finest tolerance is ");
        CHECK(baker::step_exponent_for_tolerance(finest) == exponent + 1);
        CHECK(baker::step_exponent_for_tolerance(finest * (1.0 - 3e-8)) == exponent);
    }
}

TEST_CASE("lattice: a tolerance whose steps no double can count is refused also for a flat mesh") {
    const auto bounds = bounds_between({}, {0.0f, 1.0f, 1.0f});
    for (const int exponent : {-999, -1000, -1001, -1024, -1074}) {
        const auto refused = baker::lattice_for_tolerance(bounds, exponent, std::ldexp(1.0, exponent));
        REQUIRE(!refused);
        CHECK(refused.refusal().status == BakeStatus::too_fine);
    }
}

TEST_CASE("lattice: an empty mesh gets a lattice for every step and bits") {
    const auto by_step = baker::lattice_for_tolerance(baker::SourceBounds{}, -200, 1e-60);
    REQUIRE(by_step);
    CHECK(by_step->bits == 1);
    CHECK(by_step->step_exponent == 0);
    const auto by_bits = baker::lattice_for_bits(baker::SourceBounds{}, 24);
    REQUIRE(by_bits);
    CHECK(by_bits->bits == 24);
    CHECK(by_bits->step_exponent == 0);
    const auto empty = must_bake_mesh({}, with_tolerance(0.001));
    CHECK(empty.report.tree.triangles == 0);
}

}  // namespace
}  // namespace espalier::tests::lattice_borders_test
