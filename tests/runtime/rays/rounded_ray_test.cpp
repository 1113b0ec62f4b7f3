// Tests of rays that are rounded once for a region: against the loop over all triangles, and what is refused.
#include "support/testing.hpp"

#include "rounded_ray_loop.hpp"
#include "support/machine/instruction_paths.hpp"

namespace espalier::tests::rounded_ray_test {
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

TEST_CASE("seams: a rounded ray in any region is answered as by the loop over all triangles") {
    std::uint64_t hits = 0, asked = 0;
    const auto ask = [&](const TestBlob& blob, QueryMaker& maker, std::uint64_t) {
        Ray ray = maker.any_ray();
        if (maker.random().below(3) == 0) maker.restrict(ray);
        CAPTURE(describe(ray));
        std::int32_t before[3];
        const RoundedRay rounded = round_ray(region_around(blob.opened.blob.lattice(), maker.random(), before), ray);
        REQUIRE(rounded);
        ++asked;
        hits += require_answers_of_the_loop(blob.decoded, blob.opened.blob, rounded, before) ? 1u : 0u;
    };
    ask_each<QueryMaker>(small_test_blobs(), 24, scaled_share(200), ask);
    CHECK(hits > asked / 10);
}

TEST_CASE("seams: a ray rounded for one blob is answered like the plain ray") {
    const auto ask = [](const TestBlob& blob, QueryMaker& maker, std::uint64_t) {
        const Ray ray = maker.any_ray();
        CAPTURE(describe(ray));
        const RoundedRay rounded = round_ray(blob.opened.blob.lattice(), ray);
        REQUIRE(same_bits(raycast(blob.opened.blob, rounded), raycast(blob.opened.blob, ray)));
    };
    ask_each<QueryMaker>(small_test_blobs(), 25, scaled_share(200), ask);
}

TEST_CASE("seams: what is no ray or no region is refused") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    const Lattice good = cube.blob.lattice();
    const Ray ray = {{0.25f, 0.5f, 5.0f}, {0.0f, 0.0f, -2.0f}};
    CHECK(raycast(cube.blob, round_ray(good, ray)).t == 2.0f);
    const float huge = std::numeric_limits<float>::max();
    for (unsigned number = 0; number < 8; ++number) {
        for (const float bad : {not_a_number, INFINITY, -INFINITY}) {
            if (number >= 6 && !std::isnan(bad)) continue;  // windows may be endless
            Ray broken = ray;
            *numbers_of(broken)[number] = bad;
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
        const RayHit hit = raycast(cube.blob, round_ray(good, empty));
        CHECK(hit.status == QueryStatus::not_found);
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
    CHECK(with([&](Lattice& r) { r.origin.y = not_a_number; }) == QueryStatus::invalid_argument);
    CHECK(with([](Lattice& r) { r.origin.y = INFINITY; }) == QueryStatus::invalid_argument);
    CHECK(with([](Lattice& r) { r.origin.y += std::ldexp(0.5f, r.step_exponent); }) == QueryStatus::invalid_argument);

    CHECK(raycast(cube.blob, RoundedRay()).status == QueryStatus::invalid_argument);
    CHECK(occluded(cube.blob, RoundedRay()).status() == QueryStatus::invalid_argument);
    const RayHit refused = raycast(cube.blob, round_ray(good, far));
    CHECK(refused.status == QueryStatus::out_of_range);
    CHECK(refused.triangle == no_triangle);
    CHECK(refused.t == INFINITY);
}

TEST_CASE("seams: a blob with another step or outside of the region is refused and an empty one is not hit") {
    BakeOptions options = {.resolution = Resolution::step(-8)};
    const OpenedBlob here(make_cube(-1.0f, 1.0f), options), there(make_cube(2.0f, 3.0f), options);
    options.resolution = Resolution::step(-9);
    const OpenedBlob finer(make_cube(-1.0f, 1.0f), options), nothing(Mesh{}, options);
    const Ray ray = {{0.25f, 0.5f, 5.0f}, {0.0f, 0.0f, -2.0f}};
    const RoundedRay rounded = round_ray(here.blob.lattice(), ray);
    const auto check = [&](const Blob& blob, QueryStatus status) {
        CHECK(raycast(blob, rounded).status == status);
        CHECK(occluded(blob, rounded).status() == status);
    };
    check(here.blob, QueryStatus::ok);
    check(there.blob, QueryStatus::out_of_range);
    check(finer.blob, QueryStatus::invalid_argument);
    check(nothing.blob, QueryStatus::not_found);
    check(Blob(), QueryStatus::not_open);
    // By one step on either side.
    for (int k = 0; k < 3; ++k) {
        Lattice region = here.blob.lattice();
        region.extent[k] -= 1;
        CHECK(raycast(here.blob, round_ray(region, ray)).status == QueryStatus::out_of_range);
        region.extent[k] += 1;
        (k == 0 ? region.origin.x : k == 1 ? region.origin.y : region.origin.z) += 0x1p-8f;
        CHECK(raycast(here.blob, round_ray(region, ray)).status == QueryStatus::out_of_range);
    }
}

TEST_CASE("seams: the region of several blobs holds each of them and no more") {
    BakeOptions options = {.resolution = Resolution::step(-8)};
    const OpenedBlob a(make_cube(-1.0f, 1.0f), options), b(make_cube(2.0f, 3.0f), options);
    const OpenedBlob far(make_cube(65536.0f, 65537.0f), options), nothing(Mesh{}, options);
    options.resolution = Resolution::step(-9);
    const OpenedBlob finer(make_cube(-1.0f, 1.0f), options);
    const Blob both[] = {nothing.blob, b.blob, a.blob}, never_opened[] = {b.blob, Blob()};
    Result<Lattice> region = lattice_of(both);
    CHECK(region->origin == Vec3{-1.0f, -1.0f, -1.0f});
    CHECK(region->step_exponent == -8);
    for (const std::int32_t extent : region->extent) CHECK(extent == 4 * 256);
    const Blob above_zero[] = {nothing.blob, b.blob};  // where the empty blob has its origin does not count
    region = lattice_of(above_zero);
    CHECK(region->origin == Vec3{2.0f, 2.0f, 2.0f});
    CHECK(region->extent[0] == 256);
    const Blob differ[] = {a.blob, finer.blob}, apart[] = {a.blob, far.blob};
    CHECK(lattice_of(differ).status == QueryStatus::invalid_argument);
    CHECK(lattice_of(apart).status == QueryStatus::out_of_range);
    CHECK(lattice_of(never_opened).status == QueryStatus::not_open);
    region = lattice_of(std::span<const Blob>());
    REQUIRE(region);
    CHECK(region->extent[0] == 0);
    CHECK(region->origin == Vec3{});
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
        Lattice region = cube.blob.lattice();
        for (std::uint32_t changes = random.below(3); changes > 0; --changes) {
            const auto number = static_cast<std::int32_t>(random.next()) >> random.below(32);
            if (random.coin()) region.origin.x = any();
            if (random.coin()) region.extent[random.below(3)] = number;
            if (random.below(4) == 0) region.step_exponent = number;
        }
        const Ray ray = {
            {any(), any(), any()}, {any(), any(), any()}, any(), any(), static_cast<FaceCulling>(random.below(256))};
        const RoundedRay rounded = round_ray(region, ray);
        const QueryStatus status = raycast(cube.blob, rounded).status;
        CHECK(occluded(cube.blob, rounded).status() == status);
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

}  // namespace
}  // namespace espalier::tests::rounded_ray_test
