// Claims about rays that are rounded once for a region: against the loop over all triangles, and what is refused.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include <espalier/rounded_ray.hpp>
#include <runtime/ray_triangle.hpp>

#include "../support/baking.hpp"
#include "../support/hostile_values.hpp"
#include "../support/instruction_paths.hpp"
#include "../support/mesh_makers.hpp"
#include "../support/profiles.hpp"
#include "../support/query_maker.hpp"
#include "../support/same_bits.hpp"
#include "../support/test_blobs.hpp"

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

/// In the region's own steps: nothing is moved onto the blob.
RayHit loop_over_triangles(const DecodedBlob& decoded, const std::int32_t (&before)[3], const RoundedRay& rounded) {
    const detail::RoundedRayData& data = rounded.data();
    RayHit best = {INFINITY, 0.0f, 0.0f, {}, no_triangle};
    if (data.may_hit == 0) return best;
    detail::IntegerRay ray{};
    for (int k = 0; k < 3; ++k) {
        ray.origin[k] = data.origin[k];
        ray.direction[k] = data.direction[k];
    }
    ray.fraction_bits = data.fraction_bits;
    ray.t_exponent = data.t_exponent;
    ray.tau_min = data.tau_min;
    ray.tau_max = data.tau_max;
    ray.tau_offset = data.tau_offset;
    ray.faces = data.faces;
    detail::TriangleHit nearest{};
    nearest.whole_tau = INFINITY;
    for (std::uint32_t i = 0; i < decoded.triangles.size(); ++i) {
        if (decoded.owners.size() > i && decoded.owners[i] != i) continue;
        const GridPoint* corners[3] = {&decoded.triangles[i].a, &decoded.triangles[i].b, &decoded.triangles[i].c};
        detail::LatticeTriangle triangle{};
        for (int corner = 0; corner < 3; ++corner)
            for (int k = 0; k < 3; ++k)
                triangle.corner[corner][k] = (*corners[corner])[static_cast<std::size_t>(k)] + before[k];
        detail::TriangleHit hit{};
        if (!detail::intersect(ray, triangle, hit)) continue;
        if (best.triangle != no_triangle && !(hit.whole_tau < nearest.whole_tau)) continue;
        nearest = hit;
        Ray window;
        window.t_min = data.t_min;
        window.t_max = data.t_max;
        best = detail::to_ray_hit(ray, window, hit, i);
    }
    return best;
}

detail::RayOnLattice moved(const RoundedRay& rounded, const std::int32_t (&before)[3]) {
    const detail::RoundedRayData& data = rounded.data();
    detail::RayOnLattice result{};
    for (int k = 0; k < 3; ++k) {
        result.ray.origin[k] = data.origin[k] - before[k] * (1 << data.fraction_bits);
        result.ray.direction[k] = data.direction[k];
    }
    result.ray.fraction_bits = data.fraction_bits;
    result.ray.t_exponent = data.t_exponent;
    result.ray.tau_min = data.tau_min;
    result.ray.tau_max = data.tau_max;
    result.ray.tau_offset = data.tau_offset;
    result.ray.faces = data.faces;
    detail::set_longest_axis(result.ray, data.longest_axis);
    result.t_min = data.t_min;
    result.t_max = data.t_max;
    return result;
}

QueryStatus status_of(const Lattice& region, const Ray& ray) { return round_ray(region, ray).status(); }

/// Requires the loop's bits of a ray in the blob's own region, from the public calls and on every instruction set.
void require_answers_of_the_loop(const DecodedBlob& decoded, const Blob& blob, const RoundedRay& ray) {
    constexpr std::int32_t nothing_before[3] = {};
    RayHit hit;
    bool any = false;
    REQUIRE(raycast(blob, ray, hit) == QueryStatus::ok);
    REQUIRE(occluded(blob, ray, any) == QueryStatus::ok);
    const RayHit expected = loop_over_triangles(decoded, nothing_before, ray);
    REQUIRE(same_bits(hit, expected));
    REQUIRE(any == (expected.triangle != no_triangle));
    if (ray.data().may_hit == 0) return;
    const detail::RayOnLattice on_blob = moved(ray, nothing_before);
    for (const InstructionPath& path : instruction_paths()) {
        RayHit path_hit;
        REQUIRE(path.closest_hit_on_lattice(blob.data(), on_blob, path_hit) == any);
        if (any) REQUIRE_MESSAGE(same_bits(path_hit, expected), std::string(path.name));
        REQUIRE(path.any_hit_on_lattice(blob.data(), on_blob) == any);
    }
}

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

    TEST_CASE("seams: any words are safe as a rounded ray and those that are taken are answered exactly") {
        using Words = std::array<std::uint32_t, sizeof(RoundedRay) / 4>;
        constexpr std::size_t region_word = offsetof(detail::RoundedRayData, region) / 4;
        const std::uint64_t count = scaled_share(400);
        std::uint64_t taken = 0, refused = 0;
        for (const TestBlob& blob : small_test_blobs()) {
            CAPTURE(blob.name);
            QueryMaker maker(blob.decoded, 26);
            Random& random = maker.random();
            const Lattice lattice = lattice_of(blob.opened.blob);
            for (std::uint64_t i = 0; i < count; ++i) {
                Words words = std::bit_cast<Words>(round_ray(lattice, maker.any_ray()));
                bool is_on_lattice = true;
                for (std::uint32_t changes = random.below(4); changes > 0; --changes) {
                    const std::uint32_t word = random.below(static_cast<std::uint32_t>(words.size()));
                    const auto any = static_cast<std::uint32_t>(random.next());
                    const auto small = static_cast<std::uint32_t>(static_cast<std::int32_t>(any) >> random.below(32));
                    const std::uint32_t choices[] = {
                        any, small, words[word] ^ 1u << random.below(32), words[word] + small % 3,
                        std::bit_cast<std::uint32_t>(hostile_values[random.below(hostile_values.size())])};
                    words[word] = choices[random.below(5)];
                    is_on_lattice = is_on_lattice && (word < region_word || word > region_word + 6);
                }
                if (random.below(50) == 0)
                    for (std::uint32_t& word : words) word = static_cast<std::uint32_t>(random.next());
                const auto changed = std::bit_cast<RoundedRay>(words);
                RayHit hit;
                bool any = false;
                const QueryStatus status = raycast(blob.opened.blob, changed, hit);
                REQUIRE(occluded(blob.opened.blob, changed, any) == status);
                if (status != QueryStatus::ok) {
                    CHECK((status == QueryStatus::invalid_argument || status == QueryStatus::out_of_range));
                    ++refused;
                    continue;
                }
                REQUIRE(any == (hit.triangle != no_triangle));
                if (!is_on_lattice || changed.data().may_hit == 0 || blob.opened.blob.triangle_count() == 0) continue;
                ++taken;
                require_answers_of_the_loop(blob.decoded, blob.opened.blob, changed);
            }
        }
        CHECK(taken > 0);
        CHECK(refused > 0);
    }

    TEST_CASE("seams: a rounded ray is taken up to each border of the kernels' domain and refused beyond") {
        using Data = detail::RoundedRayData;
        constexpr std::int32_t most_units = 1 << 24;
        constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min();
        constexpr std::int32_t most = std::numeric_limits<std::int32_t>::max();
        const float nan = std::numeric_limits<float>::quiet_NaN();
        const auto below = [](float number) { return std::nextafter(number, 0.0f); };
        const auto above = [](float number) { return std::nextafter(number, INFINITY); };
        const Mesh mesh = make_cube(-1.0f, 1.0f);
        const OpenedBlob cube(mesh);
        const DecodedBlob decoded = decode(cube.bytes);
        const Lattice lattice = lattice_of(cube.blob);
        for (const Vec3 direction : {Vec3{-2.0f, 0.5f, 0.25f}, Vec3{0.5f, -2.0f, 0.25f}, Vec3{0.25f, 0.5f, -2.0f}}) {
            const Ray ray = {{-2.0f * direction.x, -2.0f * direction.y, -2.0f * direction.z}, direction};
            const Data good = round_ray(lattice, ray).data();
            const unsigned along = good.longest_axis, across = (along + 1) % 3;
            REQUIRE(good.status == QueryStatus::ok);
            REQUIRE(good.may_hit == 1);
            // Without triangles nothing but the ray is tested.
            const auto is_taken = [&](auto change) {
                Data data = good;
                change(data);
                const auto changed = std::bit_cast<RoundedRay>(data);
                RayHit hit;
                bool any = true;
                const QueryStatus status = raycast(Blob(), changed, hit);
                REQUIRE(occluded(Blob(), changed, any) == status);
                REQUIRE((status == QueryStatus::ok || status == QueryStatus::invalid_argument));
                if (status == QueryStatus::ok && std::ranges::equal(data.region.extent, lattice.extent))
                    require_answers_of_the_loop(decoded, cube.blob, changed);
                else if (status != QueryStatus::ok) REQUIRE(raycast(cube.blob, changed, hit) == status);
                return status == QueryStatus::ok;
            };
            REQUIRE(is_taken([](Data&) {}));

            for (const std::int32_t bits : {0, 1, 5, 6}) CHECK(is_taken([&](Data& d) { d.fraction_bits = bits; }));
            for (const std::int32_t bits : {-1, 7, 31, 32, least, most})
                CHECK_FALSE(is_taken([&](Data& d) { d.fraction_bits = bits; }));
            for (const int axis : {3, 4, 255})
                CHECK_FALSE(is_taken([&](Data& d) { d.longest_axis = static_cast<std::uint8_t>(axis); }));

            for (unsigned k = 0; k < 3; ++k) {
                // The origin, and how far the region's far side is from it.
                const auto with = [&](std::int32_t origin, std::int32_t extent, std::int32_t bits) {
                    return is_taken([&](Data& d) {
                        d.origin[k] = origin;
                        d.region.extent[k] = extent;
                        d.fraction_bits = bits;
                        if (bits == 0) return;
                        for (unsigned other = 0; other < 3; ++other)  // within any grid
                            if (other != k) d.origin[other] = d.region.extent[other] = 0;
                    });
                };
                CHECK(with(most_units, lattice.extent[k], 6));
                CHECK_FALSE(with(most_units + 1, lattice.extent[k], 6));
                CHECK_FALSE(with(most, lattice.extent[k], 6));
                CHECK(with((lattice.extent[k] << 6) - most_units, lattice.extent[k], 6));
                CHECK_FALSE(with((lattice.extent[k] << 6) - most_units - 1, lattice.extent[k], 6));
                CHECK(with(-most_units, 0, 0));
                CHECK_FALSE(with(-most_units - 1, 0, 0));
                CHECK_FALSE(with(least, 0, 0));
                CHECK_FALSE(with(least, most_steps, 6));
                CHECK(with(0, most_steps, 0));
                CHECK_FALSE(with(0, most_steps + 1, 0));
                CHECK_FALSE(with(0, -1, 0));
                CHECK_FALSE(with(0, least, 6));
                CHECK_FALSE(with(0, 1 << 30, 6));
                CHECK(with(-1, most_steps, 0));
                CHECK_FALSE(with(-2, most_steps, 0));
            }

            for (const std::int32_t sign : {-1, 1}) {
                const auto with = [&](std::int32_t longest, std::int32_t other) {
                    return is_taken([&](Data& d) {
                        for (std::int32_t& way : d.direction) way = 0;
                        d.direction[along] = sign * longest;
                        d.direction[across] = other;
                    });
                };
                CHECK(with(most_units - 1, 0));
                CHECK_FALSE(with(most_units, 0));
                CHECK(with(most_units / 2, 0));
                CHECK_FALSE(with(most_units / 2 - 1, 0));
                CHECK_FALSE(with(0, 0));
                CHECK_FALSE(with(most, 0));
                for (const std::int32_t other : {-1, 1}) {
                    CHECK(with(most_units / 2, other * most_units / 2));
                    CHECK_FALSE(with(most_units / 2, other * (most_units / 2 + 1)));
                }
                CHECK_FALSE(with(most_units / 2, least));
            }
            CHECK_FALSE(is_taken([&](Data& d) { d.direction[along] = least; }));

            for (const std::int32_t exponent : {-272, 272}) CHECK(is_taken([&](Data& d) { d.t_exponent = exponent; }));
            for (const std::int32_t exponent : {-273, 273, least, most})
                CHECK_FALSE(is_taken([&](Data& d) { d.t_exponent = exponent; }));

            struct Tau {
                float Data::*tau;
                float most;
            };
            for (const auto& [tau, largest] : {Tau{&Data::tau_min, std::numeric_limits<float>::max()},
                                               Tau{&Data::tau_max, INFINITY}, Tau{&Data::tau_offset, 0x1p121f}}) {
                const auto with = [&](float value) { return is_taken([&](Data& d) { d.*tau = value; }); };
                for (const float value : {0.0f, -0.0f, 0x1p-100f, 1.0f, largest}) CHECK(with(value));
                for (const float value : {below(0x1p-100f), std::numeric_limits<float>::denorm_min(), -0x1p-100f, -1.0f,
                                          -INFINITY, nan, -nan})
                    CHECK_FALSE(with(value));
                CHECK_FALSE(with(std::bit_cast<float>(std::bit_cast<std::uint32_t>(largest) + 1)));
            }
            CHECK_FALSE(is_taken([&](Data& d) { d.tau_min = INFINITY; }));
            CHECK_FALSE(is_taken([&](Data& d) { d.tau_offset = above(0x1p121f); }));
            for (float Data::*window : {&Data::t_min, &Data::t_max}) {
                for (const float value : {-INFINITY, -1.0f, 0.0f, std::numeric_limits<float>::denorm_min(), INFINITY})
                    CHECK(is_taken([&](Data& d) { d.*window = value; }));
                for (const float value : {nan, -nan, std::bit_cast<float>(0x7F800001u)})
                    CHECK_FALSE(is_taken([&](Data& d) { d.*window = value; }));
            }
        }
    }

    TEST_CASE("seams: a rounded ray with a status that round_ray does not leave is refused") {
        const OpenedBlob cube(make_cube(-1.0f, 1.0f));
        const detail::RoundedRayData good =
            round_ray(lattice_of(cube.blob), {{0.25f, 0.5f, 5.0f}, {0.0f, 0.0f, -2.0f}}).data();
        for (unsigned status = 0; status < 256; ++status) {
            for (const Blob& blob : {cube.blob, Blob()}) {
                detail::RoundedRayData data = good;
                data.status = static_cast<QueryStatus>(status);
                const bool is_returned = data.status == QueryStatus::ok || data.status == QueryStatus::out_of_range;
                const QueryStatus expected = is_returned ? data.status : QueryStatus::invalid_argument;
                RayHit hit;
                bool any = false;
                CHECK(raycast(blob, std::bit_cast<RoundedRay>(data), hit) == expected);
                CHECK(occluded(blob, std::bit_cast<RoundedRay>(data), any) == expected);
            }
        }
    }

    TEST_CASE("seams: a ray that may hit nothing is taken whatever else its words are") {
        const OpenedBlob cube(make_cube(-1.0f, 1.0f));
        detail::RoundedRayData data;
        data.region = lattice_of(cube.blob);
        data.status = QueryStatus::ok;
        data.fraction_bits = std::numeric_limits<std::int32_t>::max();
        for (std::int32_t& origin : data.origin) origin = std::numeric_limits<std::int32_t>::min();
        for (const Blob& blob : {cube.blob, Blob()}) {
            RayHit hit = {};
            bool any = true;
            CHECK(raycast(blob, std::bit_cast<RoundedRay>(data), hit) == QueryStatus::ok);
            CHECK(hit.triangle == no_triangle);
            CHECK(hit.t == INFINITY);
            CHECK(occluded(blob, std::bit_cast<RoundedRay>(data), any) == QueryStatus::ok);
            CHECK_FALSE(any);
        }
    }

    TEST_CASE("seams: a ray that is rounded at a border of numbers is taken again") {
        BakeOptions options;
        for (const int exponent : {-100, 100}) {
            options.step_exponent = exponent;
            const OpenedBlob cube(make_cube(0.0f, std::ldexp(1.0f, exponent + 8)), options);
            const Lattice region = lattice_of(cube.blob);
            const float least = std::numeric_limits<float>::denorm_min(), most = std::numeric_limits<float>::max();
            for (const float length : {least, std::numeric_limits<float>::min(), 1.0f, most}) {
                const Vec3 origin = {std::ldexp(1.0f, exponent + 7), std::ldexp(1.0f, exponent + 7),
                                     std::ldexp(1.0f, exponent + 9)};
                const RoundedRay rounded = round_ray(region, {origin, {0.0f, 0.0f, -length}});
                REQUIRE(rounded);
                REQUIRE(rounded.data().may_hit == 1);
                RayHit hit;
                REQUIRE(raycast(cube.blob, rounded, hit) == QueryStatus::ok);
                CHECK(hit.triangle != no_triangle);
            }
        }
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
