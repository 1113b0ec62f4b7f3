// Claims about the rounding of queries: to the last bit as it was. What is answered is the query as it was rounded, so
// that any other rounding is another answer, however good.
#include <doctest/doctest.h>

#include <cfenv>

#include <runtime/lattice/to_local.hpp>
#include <runtime/lattice/round_point.hpp>
#include <runtime/lattice/round_ray.hpp>

#include "platform/fingerprint.hpp"
#include "support/queries/some_ray.hpp"

namespace espalier::tests::rounding_test {
namespace {

using platform::Fingerprint;

void add(Fingerprint& sum, const detail::LatticeRay& ray, const detail::RaySlope& slope) {
    for (int k = 0; k < 3; ++k) {
        sum.add(static_cast<std::uint32_t>(ray.origin[k]), static_cast<std::uint32_t>(ray.direction[k]),
                std::uint32_t{ray.axis[k]}, slope.inverse[k], detail::origin_steps(ray, static_cast<unsigned>(k)));
    }
    sum.add(slope.slack_steps, static_cast<std::uint32_t>(ray.fraction_bits),
            static_cast<std::uint32_t>(ray.t_exponent));
    for (const float number : {ray.tau_min, ray.tau_max, ray.tau_offset, ray.shear[0], ray.shear[1], ray.shear_error})
        sum.add(number);
}

TEST_CASE("rounding: rays round to the recorded bits") {
    Fingerprint sum;
    std::uint32_t rounded = 0, far = 0, divided_by_zero = 0;
    for (std::uint32_t seed = 0; seed < 500; ++seed) {
        Random random(seed);
        const detail::BlobData asset = some_asset(random);
        for (int i = 0; i < 200; ++i) {
            const Ray world = some_ray(asset, random);
            detail::LatticeRay ray;
            detail::RaySlope slope{};
            std::feclearexcept(FE_ALL_EXCEPT);
            const bool good = detail::round_ray(asset, world, ray, slope);
            divided_by_zero += std::fetestexcept(FE_DIVBYZERO) != 0 ? 1u : 0u;  // a program may have it trap
            sum.add(good);
            if (!good) continue;
            ++rounded;
            far += ray.tau_offset > 0.0f ? 1u : 0u;
            add(sum, ray, slope);
            for (const float tau : {0.0f, 1.0f, 0x1p-20f, 12345.678f, ray.tau_min, ray.tau_max}) {
                sum.add(detail::to_t(ray, tau, world));
                if (tau < infinity) sum.add(detail::hit_limit(ray, tau));
            }
        }
    }
    CHECK(rounded > 30'000);
    CHECK(far > 1'000);
    CHECK(divided_by_zero == 0);
    CHECK(sum.value() == 643900965860527618u);
}

TEST_CASE("rounding: points and radii and bounds round to the recorded bits") {
    Fingerprint sum;
    std::uint32_t rounded = 0, far = 0;
    for (std::uint32_t seed = 0; seed < 500; ++seed) {
        Random random(seed);
        const detail::BlobData asset = some_asset(random);
        for (int i = 0; i < 200; ++i) {
            const Vec3 place = some_place(asset, random);
            const float radius = random.below(4) == 0 ? some_hostile(random) : some_component(random);
            detail::RoundedPoint point;
            const bool good = detail::round_point(asset, place, radius, point) == QueryStatus::ok;
            sum.add(good);
            if (!good) continue;
            ++rounded;
            far += point.distance_offset > 0.0f ? 1u : 0u;
            for (int k = 0; k < 3; ++k) {
                sum.add(static_cast<std::uint32_t>(point.origin[k]), static_cast<std::uint32_t>(point.origin[k] >> 32),
                        point.steps[k]);
            }
            sum.add(point.steps[3], static_cast<std::uint32_t>(point.fraction_bits));
            for (const float number : {point.radius, point.limit, point.inner_limit, point.distance_offset})
                sum.add(number);
        }
        for (int i = 0; i < 50; ++i) {
            const float x = random.coin() ? some_hostile(random) : some_component(random);
            if (!detail::is_nan(x)) {
                sum.add(detail::next_above(x), detail::next_below(x));
            }
            const auto steps = i == 0 ? 1 << 24 : static_cast<std::int32_t>(random.below(i % 2 == 0 ? 1u << 27 : 300u));
            for (int axis = 0; axis < 3; ++axis) {
                sum.add(detail::world_above(asset, axis, steps), detail::world_below(asset, axis, steps));
            }
            const Vec3 a = some_place(asset, random), b = some_place(asset, random);
            sum.add(detail::is_empty({a, b}), detail::is_empty({a, a}), detail::is_nan(a) || detail::is_finite(b));
        }
    }
    CHECK(rounded > 30'000);
    CHECK(far > 1'000);
    CHECK(sum.value() == 11255883713935737109u);
}

TEST_CASE("rounding: a ray that leaves the widest asset where it begins is accepted") {
    detail::BlobData asset;
    asset.bits = format::max_bits;
    for (std::int32_t& side : asset.extent) side = (1 << format::max_bits) - 1;
    asset.derive();
    for (unsigned axis = 0; axis < 3; ++axis)
        for (const bool up : {false, true}) {
            Ray world;
            float* const origin[3] = {&world.origin.x, &world.origin.y, &world.origin.z};
            float* const direction[3] = {&world.direction.x, &world.direction.y, &world.direction.z};
            for (unsigned k = 0; k < 3; ++k) {
                *origin[k] = k == axis ? (up ? 0x1p24f - 1.0f : 0.0f) : 5.0f;
                *direction[k] = k == axis ? (up ? 1.0f : -1.0f) : 0.0f;
            }
            detail::LatticeRay ray;
            CHECK(detail::round_ray(asset, world, ray));
        }
}

}  // namespace
}  // namespace espalier::tests::rounding_test
