// Claims about the one rounding of a ray: how little it moves, and the invariants that the exact kernels build on.
#include "support/testing.hpp"

#include "support/exact/as_rationals.hpp"

namespace espalier::tests::round_ray_test {
namespace {

using detail::LatticeRay;

/// An asset somewhere, of some size, as the header of a blob would describe it.
detail::BlobData some_asset(Random& random) {
    detail::BlobData data = tests::lattice_asset(1 + random.below(24));
    data.step_exponent = static_cast<std::int16_t>(random.between(-40, 20));
    const float size = std::ldexp(1.0f, data.step_exponent + data.bits);
    const float away = std::ldexp(size, static_cast<int>(random.below(6)));
    for (int k = 0; k < 3; ++k) {
        data.origin[k] = random.below(3) == 0 ? 0.0f : random.signed_unit() * away;
        data.extent[k] = random.between(0, data.extent[k]);
    }
    data.extent[random.below(3)] = (1 << data.bits) - 1;
    data.derive();
    return data;
}

Ray some_ray(const detail::BlobData& data, Random& random, float sizes_away) {
    const float size = std::ldexp(1.0f, data.step_exponent + data.bits);
    const Vec3 from = random.in_cube(size * sizes_away);
    const Vec3 to = random.in_cube(size);
    Ray ray = {.origin = {data.origin[0] + from.x, data.origin[1] + from.y, data.origin[2] + from.z},
               .direction = difference(to, from)};
    if (random.below(4) == 0) ray.direction.x = 0.0f;
    return ray;
}

TEST_CASE("rounding: a direction is scaled by a power of two and rounded to half a unit of 24 bits") {
    Random random(1);
    for (std::uint64_t i = 0; i < scaled(5'000); ++i) {
        const detail::BlobData data = some_asset(random);
        Ray world = some_ray(data, random, 2.0f);
        // Down to directions that are subnormal throughout.
        const int shift = random.below(3) == 0 ? random.between(-140, 100) : 0;
        world.direction = {std::ldexp(world.direction.x, shift), std::ldexp(world.direction.y, shift),
                           std::ldexp(world.direction.z, shift)};
        LatticeRay ray;
        if (!detail::round_ray(data, world, ray)) continue;
        const float given[3] = {world.direction.x, world.direction.y, world.direction.z};
        std::int32_t longest = 0;
        for (int k = 0; k < 3; ++k) {
            longest = std::max(longest, std::abs(ray.direction[k]));
            // tau counts in direction * 2^step per 2^t_exponent, so that t is in units of the given direction.
            const Rational rounded = Rational::of(ray.direction[k], data.step_exponent - ray.t_exponent);
            const Rational half_unit = Rational::of(1, data.step_exponent - ray.t_exponent - 1);
            REQUIRE(oracle::absolute(rounded - Rational::of(given[k])) <= half_unit);
            if (given[k] == 0.0f) REQUIRE(ray.direction[k] == 0);
        }
        REQUIRE(longest >= 1 << 23);
        REQUIRE(longest < 1 << 24);
    }
}

TEST_CASE("rounding: a ray origin near the asset moves by at most half a 64th of a step and half an ulp") {
    Random random(2);
    std::uint64_t checked = 0;
    for (std::uint64_t i = 0; i < scaled(5'000); ++i) {
        const detail::BlobData data = some_asset(random);
        const Ray world = some_ray(data, random, std::ldexp(1.0f, random.between(-3, 5)));
        LatticeRay ray;
        if (!detail::round_ray(data, world, ray) || ray.tau_offset != 0.0f) continue;
        const float given[3] = {world.origin.x, world.origin.y, world.origin.z};
        Rational reach = 0;
        for (int k = 0; k < 3; ++k) {
            const Rational exact =
                (Rational::of(given[k]) - Rational::of(data.origin[k])) * Rational::of(1, -data.step_exponent);
            const Rational rounded = Rational::of(ray.origin[k], -ray.fraction_bits);
            const Rational allowed =
                Rational::of(1, -ray.fraction_bits - 1) + oracle::absolute(exact) * Rational::of(1, -24);
            REQUIRE(oracle::absolute(rounded - exact) <= allowed);
            REQUIRE(Rational::of(origin_steps(ray, static_cast<unsigned>(k))) == rounded);
            reach = std::max({reach, oracle::absolute(exact), oracle::absolute(exact - Rational(data.extent[k]))});
        }
        REQUIRE(ray.fraction_bits >= 0);
        REQUIRE(ray.fraction_bits <= 6);
        // As fine as 25 bits of reach allow: the perturbation stays below what float32 input has.
        if (ray.fraction_bits < 6) REQUIRE(reach * Rational::of(1, ray.fraction_bits + 2) >= Rational::of(1, 24));
        ++checked;
    }
    CHECK(checked > scaled(5'000) / 4);
}

TEST_CASE("rounding: no corner is more than 2^24 units from a rounded origin") {
    Random random(3);
    std::uint64_t moved = 0;
    for (std::uint64_t i = 0; i < scaled(20'000); ++i) {
        const detail::BlobData data = some_asset(random);
        const Ray world = some_ray(data, random, std::ldexp(1.0f, random.between(-3, 60)));
        LatticeRay ray;
        if (!detail::round_ray(data, world, ray)) continue;
        for (int k = 0; k < 3; ++k) {
            const std::int64_t low = ray.origin[k];
            const std::int64_t high = (std::int64_t{data.extent[k]} << ray.fraction_bits) - ray.origin[k];
            REQUIRE(std::abs(low) <= 1 << 24);
            REQUIRE(std::abs(high) <= 1 << 24);
        }
        REQUIRE(ray.tau_min >= 0.0f);
        REQUIRE(ray.tau_max >= 0.0f);
        if (ray.tau_offset > 0.0f) ++moved;
    }
    CHECK(moved > scaled(20'000) / 20);
}

TEST_CASE("rounding: an origin from far away moves along its ray within float precision of the line") {
    Random random(4);
    std::uint64_t moved = 0;
    for (std::uint64_t i = 0; i < scaled(20'000); ++i) {
        const detail::BlobData data = some_asset(random);
        const float sizes_away = std::ldexp(1.0f, random.between(4, 40));
        const Ray world = some_ray(data, random, sizes_away);
        LatticeRay ray;
        if (!detail::round_ray(data, world, ray) || !(ray.tau_offset > 0.0f)) continue;
        ++moved;
        const float given[3] = {world.origin.x, world.origin.y, world.origin.z};
        const Rational offset = Rational::of(ray.tau_offset);
        Rational farthest = 0;
        for (int k = 0; k < 3; ++k) {
            farthest = std::max(farthest, oracle::absolute(Rational::of(given[k]) - Rational::of(data.origin[k])) *
                                              Rational::of(1, -data.step_exponent));
        }
        for (int k = 0; k < 3; ++k) {
            const Rational start =
                (Rational::of(given[k]) - Rational::of(data.origin[k])) * Rational::of(1, -data.step_exponent);
            const Rational on_line = start + offset * Rational(ray.direction[k]);
            const Rational rounded = Rational::of(ray.origin[k], -ray.fraction_bits);
            const Rational allowed = farthest * Rational::of(1, -20) + Rational::of(1, -ray.fraction_bits);
            REQUIRE(oracle::absolute(rounded - on_line) <= allowed);
        }
    }
    CHECK(moved > scaled(20'000) / 20);
}

TEST_CASE("rounding: invalid rays and empty windows are refused") {
    const detail::BlobData data = tests::lattice_asset(16);
    const Ray good{{1.0f, 2.0f, -3.0f}, {0.0f, 0.0f, 1.0f}};
    LatticeRay ray;
    REQUIRE(detail::round_ray(data, good, ray));
    for (const float bad : {not_a_number, -not_a_number, infinity, -infinity}) {
        for (float Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
            Ray broken = good;
            broken.origin.*axis = bad;
            CHECK_FALSE(detail::round_ray(data, broken, ray));
            broken = good;
            broken.direction.*axis = bad;
            CHECK_FALSE(detail::round_ray(data, broken, ray));
        }
    }
    const auto with_window = [&](float t_min, float t_max) {
        Ray windowed = good;
        windowed.t_min = t_min;
        windowed.t_max = t_max;
        return detail::round_ray(data, windowed, ray);
    };
    CHECK_FALSE(with_window(not_a_number, 1.0f));
    CHECK_FALSE(with_window(0.0f, not_a_number));
    CHECK_FALSE(with_window(2.0f, 1.0f));
    CHECK_FALSE(with_window(0.0f, -1.0f));
    CHECK_FALSE(with_window(infinity, infinity));
    CHECK_FALSE(with_window(0.0f, -infinity));
    CHECK(with_window(-infinity, infinity));
    CHECK(with_window(0.0f, 0.0f));
    CHECK(with_window(-0.0f, -0.0f));
    Ray still = good;
    still.direction = {0.0f, -0.0f, 0.0f};
    CHECK_FALSE(detail::round_ray(data, still, ray));
    still.direction = {0.0f, -std::numeric_limits<float>::denorm_min(), 0.0f};
    CHECK(detail::round_ray(data, still, ray));
    CHECK(ray.direction[1] == -(1 << 23));
}

TEST_CASE("rounding: any ray is refused or rounded within the invariants") {
    Random random(5);
    std::uint64_t rounded = 0;
    for (std::uint64_t i = 0; i < scaled(200'000); ++i) {
        const detail::BlobData data = some_asset(random);
        const auto any = [&] {
            return random.coin() ? tests::hostile_values[random.below(tests::hostile_values.size())]
                                 : std::bit_cast<float>(static_cast<std::uint32_t>(random.next()));
        };
        const Ray world{{any(), any(), any()}, {any(), any(), any()}, any(), any(), FaceCulling::none};
        LatticeRay ray;
        detail::RaySlope slope;
        if (!detail::round_ray(data, world, ray, slope)) continue;
        ++rounded;
        std::int32_t longest = 0;
        for (int k = 0; k < 3; ++k) {
            longest = std::max(longest, std::abs(ray.direction[k]));
            REQUIRE(std::abs(std::int64_t{ray.origin[k]}) <= 1 << 24);
            REQUIRE(std::isfinite(origin_steps(ray, static_cast<unsigned>(k))));
            REQUIRE_FALSE(std::isnan(slope.inverse[k]));
        }
        REQUIRE((longest >= 1 << 23 && longest < 1 << 24));
        REQUIRE((ray.fraction_bits >= 0 && ray.fraction_bits <= 6));
        REQUIRE(ray.tau_min >= 0.0f);
        REQUIRE(ray.tau_max >= 0.0f);
    }
    CHECK(rounded > scaled(200'000) / 1'000);
}

}  // namespace
}  // namespace espalier::tests::round_ray_test
