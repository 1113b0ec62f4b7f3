// Tests of rays that are rounded once for a region: against the loop over all triangles, and what is refused.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include <espalier/rounded_ray.hpp>

#include "rounded_ray_loop.hpp"
#include "support/base/hostile_values.hpp"
#include "support/base/profiles.hpp"
#include "support/base/same_bits.hpp"
#include "support/blobs/baking.hpp"
#include "support/blobs/test_blobs.hpp"
#include "support/machine/instruction_paths.hpp"
#include "support/meshes/makers.hpp"
#include "support/queries/ray_maker.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

constexpr std::int32_t most_steps = (1 << 24) - 1;

/// A region around the blob, with so much room before and behind it that steps are whole in float32.
Lattice region_around(const Lattice& lattice, Random& random, std::int32_t (&before)[3]) {
    Lattice region = lattice;
    float* origin[3] = {&region.origin.x, &region.origin.y, &region.origin.z};
    for (int k = 0; k < 3; ++k) {
        const std::int32_t room = most_steps - lattice.extent[k];
        std::int32_t steps = random.between(0, room) >> random.below(24);
        const double moved = double(*origin[k]) - std::ldexp(steps, lattice.step_exponent);
        if (double(static_cast<float>(moved)) != moved) steps = 0;
        before[k] = steps;
        *origin[k] = static_cast<float>(double(*origin[k]) - std::ldexp(steps, lattice.step_exponent));
        const std::int32_t behind = random.between(0, room - steps) >> random.below(24);
        region.extent[k] = steps + lattice.extent[k] + behind;
    }
    return region;
}

QueryStatus status_of(const Lattice& region, const Ray& ray) { return round_ray(region, ray).status(); }

}  // namespace

TEST_SUITE("rounded ray") {
    TEST_CASE("seams: a rounded ray in any region is answered as by the loop over all triangles") {
        const std::uint64_t count = scaled_share(200);
        std::uint64_t hits = 0, asked = 0;
        for (const TestBlob& blob : small_test_blobs()) {
            CAPTURE(blob.name);
            QueryMaker maker(blob.decoded, 24);
            const Lattice lattice = lattice_of(blob.opened.blob);
            for (std::uint64_t i = 0; i < count; ++i) {
                Ray ray = maker.any_ray();
                if (maker.random().below(3) == 0) maker.restrict(ray);
                CAPTURE(describe(ray));
                std::int32_t before[3];
                const RoundedRay rounded = round_ray(region_around(lattice, maker.random(), before), ray);
                REQUIRE(rounded);
                const RayHit expected = loop_over_triangles(blob.decoded, before, rounded);
                RayHit hit;
                REQUIRE(raycast(blob.opened.blob, rounded, hit) == QueryStatus::ok);
                REQUIRE(same_bits(hit, expected));
                bool any = false;
                REQUIRE(occluded(blob.opened.blob, rounded, any) == QueryStatus::ok);
                REQUIRE(any == (expected.triangle != no_triangle));
                ++asked;
                hits += any ? 1u : 0u;
                if (rounded.data().may_hit == 0) continue;
                const detail::RayOnLattice on_blob = moved(rounded, before);
                for (const InstructionPath& path : instruction_paths()) {
                    RayHit path_hit;
                    const bool found = path.closest_hit_on_lattice(blob.opened.blob.data(), on_blob, path_hit);
                    REQUIRE_MESSAGE(found == any, std::string(path.name));
                    if (found) REQUIRE_MESSAGE(same_bits(path_hit, expected), std::string(path.name));
                    REQUIRE_MESSAGE(path.any_hit_on_lattice(blob.opened.blob.data(), on_blob) == any,
                                    std::string(path.name));
                }
            }
        }
        CHECK(hits > asked / 10);
    }

    TEST_CASE("seams: a ray rounded for one blob is answered like the plain ray") {
        const std::uint64_t count = scaled_share(200);
        for (const TestBlob& blob : small_test_blobs()) {
            CAPTURE(blob.name);
            QueryMaker maker(blob.decoded, 25);
            const Lattice lattice = lattice_of(blob.opened.blob);
            for (std::uint64_t i = 0; i < count; ++i) {
                const Ray ray = maker.any_ray();
                CAPTURE(describe(ray));
                RayHit plain = {INFINITY, 0.0f, 0.0f, {}, no_triangle}, hit;
                (void)raycast(blob.opened.blob, ray, plain);
                REQUIRE(raycast(blob.opened.blob, round_ray(lattice, ray), hit) == QueryStatus::ok);
                REQUIRE(same_bits(hit, plain));
            }
        }
    }

    TEST_CASE("seams: what is no ray or no region is refused and leaves the result alone") {
        const OpenedBlob cube(make_cube(-1.0f, 1.0f));
        const Lattice good = lattice_of(cube.blob);
        const Ray ray = {{0.25f, 0.5f, 5.0f}, {0.0f, 0.0f, -2.0f}};
        RayHit hit;
        REQUIRE(raycast(cube.blob, round_ray(good, ray), hit) == QueryStatus::ok);
        CHECK(hit.t == 2.0f);
        const float nan = std::numeric_limits<float>::quiet_NaN(), huge = std::numeric_limits<float>::max();
        for (int number = 0; number < 8; ++number) {
            for (const float bad : {nan, INFINITY, -INFINITY}) {
                if (number >= 6 && !std::isnan(bad)) continue;  // windows may be endless
                Ray broken = ray;
                float* numbers[8] = {&broken.origin.x,    &broken.origin.y,    &broken.origin.z, &broken.direction.x,
                                     &broken.direction.y, &broken.direction.z, &broken.t_min,    &broken.t_max};
                *numbers[number] = bad;
                CHECK(status_of(good, broken) == QueryStatus::invalid_argument);
            }
        }
        Ray still = ray;
        still.direction = {0.0f, -0.0f, 0.0f};
        CHECK(status_of(good, still) == QueryStatus::invalid_argument);
        Ray far = ray;
        far.origin.x = huge;
        CHECK(status_of(good, far) == QueryStatus::out_of_range);
        for (const float window : {-1.0f, INFINITY}) {
            Ray empty = ray;
            (window < 0.0f ? empty.t_max : empty.t_min) = window;
            CHECK(status_of(good, empty) == QueryStatus::ok);
            REQUIRE(raycast(cube.blob, round_ray(good, empty), hit) == QueryStatus::ok);
            CHECK(hit.triangle == no_triangle);
            CHECK(hit.t == INFINITY);
        }

        const auto with = [&](auto change) {
            Lattice region = good;
            change(region);
            return status_of(region, ray);
        };
        CHECK(with([](Lattice& r) { r.extent[2] = most_steps; }) == QueryStatus::ok);
        CHECK(with([](Lattice& r) { r.extent[2] = most_steps + 1; }) == QueryStatus::invalid_argument);
        CHECK(with([](Lattice& r) { r.extent[0] = -1; }) == QueryStatus::invalid_argument);
        CHECK(with([](Lattice& r) { r.step_exponent = 101; }) == QueryStatus::invalid_argument);
        CHECK(with([](Lattice& r) { r.step_exponent = -101; }) == QueryStatus::invalid_argument);
        for (const std::int32_t exponent : {-101, 101, 1 << 16, -(1 << 16)}) {
            const Lattice region = {{}, exponent, {1, 1, 1}};
            CHECK(status_of(region, ray) == QueryStatus::invalid_argument);
        }
        CHECK(with([&](Lattice& r) { r.origin.y = nan; }) == QueryStatus::invalid_argument);
        CHECK(with([](Lattice& r) { r.origin.y = INFINITY; }) == QueryStatus::invalid_argument);
        CHECK(with([](Lattice& r) { r.origin.y += std::ldexp(0.5f, r.step_exponent); }) ==
              QueryStatus::invalid_argument);

        hit.t = 17.0f;
        bool any = true;
        CHECK(raycast(cube.blob, RoundedRay(), hit) == QueryStatus::invalid_argument);
        CHECK(occluded(cube.blob, RoundedRay(), any) == QueryStatus::invalid_argument);
        CHECK(raycast(cube.blob, round_ray(good, far), hit) == QueryStatus::out_of_range);
        CHECK(hit.t == 17.0f);
        CHECK(any);
    }

    TEST_CASE("seams: a blob with another step or outside of the region is refused and an empty one is not hit") {
        BakeOptions options;
        options.step_exponent = -8;
        const OpenedBlob here(make_cube(-1.0f, 1.0f), options), there(make_cube(2.0f, 3.0f), options);
        options.step_exponent = -9;
        const OpenedBlob finer(make_cube(-1.0f, 1.0f), options), nothing(Mesh{}, options);
        const Ray ray = {{0.25f, 0.5f, 5.0f}, {0.0f, 0.0f, -2.0f}};
        const RoundedRay rounded = round_ray(lattice_of(here.blob), ray);
        RayHit hit;
        bool any = false;
        CHECK(raycast(here.blob, rounded, hit) == QueryStatus::ok);
        CHECK(raycast(there.blob, rounded, hit) == QueryStatus::out_of_range);
        CHECK(occluded(there.blob, rounded, any) == QueryStatus::out_of_range);
        CHECK(raycast(finer.blob, rounded, hit) == QueryStatus::invalid_argument);
        CHECK(occluded(finer.blob, rounded, any) == QueryStatus::invalid_argument);
        CHECK_FALSE(any);
        for (const Blob& empty : {nothing.blob, Blob()}) {
            REQUIRE(raycast(empty, rounded, hit) == QueryStatus::ok);
            CHECK(hit.triangle == no_triangle);
            REQUIRE(occluded(empty, rounded, any) == QueryStatus::ok);
            CHECK_FALSE(any);
        }
        // By one step on either side.
        for (int k = 0; k < 3; ++k) {
            Lattice region = lattice_of(here.blob);
            region.extent[k] -= 1;
            CHECK(raycast(here.blob, round_ray(region, ray), hit) == QueryStatus::out_of_range);
            region.extent[k] += 1;
            (k == 0 ? region.origin.x : k == 1 ? region.origin.y : region.origin.z) += 0x1p-8f;
            CHECK(raycast(here.blob, round_ray(region, ray), hit) == QueryStatus::out_of_range);
        }
    }

    TEST_CASE("seams: the region of several blobs holds each of them and no more") {
        BakeOptions options;
        options.step_exponent = -8;
        const OpenedBlob a(make_cube(-1.0f, 1.0f), options), b(make_cube(2.0f, 3.0f), options);
        const OpenedBlob far(make_cube(65536.0f, 65537.0f), options), nothing(Mesh{}, options);
        options.step_exponent = -9;
        const OpenedBlob finer(make_cube(-1.0f, 1.0f), options);
        const Blob both[] = {nothing.blob, b.blob, Blob(), a.blob};
        Lattice region;
        REQUIRE(lattice_of(both, region) == QueryStatus::ok);
        CHECK(region.origin == Vec3{-1.0f, -1.0f, -1.0f});
        CHECK(region.step_exponent == -8);
        for (const std::int32_t extent : region.extent) CHECK(extent == 4 * 256);
        const Blob above_zero[] = {nothing.blob, b.blob};  // where the empty blob has its origin does not count
        REQUIRE(lattice_of(above_zero, region) == QueryStatus::ok);
        CHECK(region.origin == Vec3{2.0f, 2.0f, 2.0f});
        CHECK(region.extent[0] == 256);
        REQUIRE(lattice_of(both, region) == QueryStatus::ok);
        const Blob differ[] = {a.blob, finer.blob}, apart[] = {a.blob, far.blob};
        CHECK(lattice_of(differ, region) == QueryStatus::invalid_argument);
        CHECK(lattice_of(apart, region) == QueryStatus::out_of_range);
        CHECK(region.extent[0] == 4 * 256);
        REQUIRE(lattice_of(std::span<const Blob>(), region) == QueryStatus::ok);
        CHECK(region.extent[0] == 0);
        CHECK(region.origin == Vec3{});
    }

    TEST_CASE("seams: any bits are safe as arguments") {
        const OpenedBlob cube(make_cube(-1.0f, 1.0f));
        Random random(9);
        const auto any = [&] {
            return random.coin() ? hostile_values[random.below(hostile_values.size())]
                                 : std::bit_cast<float>(static_cast<std::uint32_t>(random.next()));
        };
        std::uint64_t taken = 0;
        for (std::uint64_t i = 0; i < scaled(50'000); ++i) {
            Lattice region = lattice_of(cube.blob);
            for (std::uint32_t changes = random.below(3); changes > 0; --changes) {
                const auto number = static_cast<std::int32_t>(random.next()) >> random.below(32);
                if (random.coin()) region.origin.x = any();
                if (random.coin()) region.extent[random.below(3)] = number;
                if (random.below(4) == 0) region.step_exponent = number;
            }
            const Ray ray = {
                {any(), any(), any()}, {any(), any(), any()}, any(), any(), static_cast<Faces>(random.below(256))};
            const RoundedRay rounded = round_ray(region, ray);
            RayHit hit;
            bool hits = false;
            const QueryStatus status = raycast(cube.blob, rounded, hit);
            CHECK(occluded(cube.blob, rounded, hits) == status);
            if (!rounded) CHECK(status == rounded.status());
            taken += rounded ? 1u : 0u;
        }
        CHECK(taken > 0);
    }

    TEST_CASE("seams: below 2^18 steps the origin moves by at most 3 parts in 256 of a step") {
        Random random(27);
        Lattice region;
        region.step_exponent = -9;
        for (std::int32_t& extent : region.extent) extent = 65535;
        region.origin = {-150.0f, -150.0f, -150.0f};
        double most = 0.0;
        for (std::uint64_t i = 0; i < scaled(20'000); ++i) {
            const Ray ray = {random.in_cube(199.7f), {0.5f, 0.25f, 1.0f}};
            const RoundedRay rounded = round_ray(region, ray);
            const detail::RoundedRayData& data = rounded.data();
            REQUIRE(data.may_hit != 0);
            REQUIRE(data.fraction_bits == 6);
            const double exact[3] = {double(ray.origin.x) + 150.0, double(ray.origin.y) + 150.0,
                                     double(ray.origin.z) + 150.0};
            for (int k = 0; k < 3; ++k) most = std::max(most, std::abs(data.origin[k] * 0x1p-6 - exact[k] * 0x1p9));
        }
        CHECK(most <= 1.5 * 0x1p-7);
        CHECK(most > 0x1p-7);
    }
}
