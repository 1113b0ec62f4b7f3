// Tests of rounded rays at the borders of what is taken: the words of a handle, and regions.
#include "support/testing.hpp"

#include "rounded_ray_loop.hpp"

namespace espalier::tests::rounded_ray_borders_test {
namespace {

constexpr std::int32_t most_steps = (1 << 24) - 1;

TEST_CASE("seams: any words are safe as a rounded ray and those that are taken are answered exactly") {
    using Words = std::array<std::uint32_t, sizeof(RoundedRay) / 4>;
    constexpr std::size_t region_word = offsetof(detail::RoundedRayData, region) / 4;
    const std::uint64_t count = scaled_share(400);
    std::uint64_t taken = 0, refused = 0;
    for (const TestBlob& blob : small_test_blobs()) {
        CAPTURE(blob.name);
        QueryMaker maker(blob.decoded, 26);
        Random& random = maker.random();
        const Lattice lattice = blob.opened.blob.lattice();
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
            const RayHit hit = raycast(blob.opened.blob, changed);
            const QueryStatus status = hit.status;
            REQUIRE(occluded(blob.opened.blob, changed).status() == status);
            if (is_refused(status)) {
                CHECK((status == QueryStatus::invalid_argument || status == QueryStatus::out_of_range));
                ++refused;
                continue;
            }
            REQUIRE(bool(hit) == (hit.triangle != no_triangle));
            if (!is_on_lattice || changed.data().may_hit == 0 || blob.opened.blob.triangle_count() == 0) continue;
            ++taken;
            (void)require_answers_of_the_loop(blob.decoded, blob.opened.blob, changed);
        }
    }
    CHECK(taken > 0);
    CHECK(refused > 0);
}

TEST_CASE("seams: a rounded ray is taken up to each border of what kernels rely on and refused beyond") {
    using Data = detail::RoundedRayData;
    constexpr std::int32_t most_units = 1 << 24;
    constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min();
    constexpr std::int32_t most = std::numeric_limits<std::int32_t>::max();
    const auto below = [](float number) { return std::nextafter(number, 0.0f); };
    const auto above = [](float number) { return std::nextafter(number, INFINITY); };
    const Mesh mesh = make_cube(-1.0f, 1.0f);
    const OpenedBlob cube(mesh), empty(Mesh{});
    const DecodedBlob decoded = decode(cube.bytes);
    const Lattice lattice = cube.blob.lattice();
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
            const QueryStatus status = raycast(empty.blob, changed).status;
            REQUIRE(occluded(empty.blob, changed).status() == status);
            const bool is_ray = status == QueryStatus::not_found;
            REQUIRE((is_ray || status == QueryStatus::invalid_argument));
            if (is_ray && std::ranges::equal(data.region.extent, lattice.extent))
                (void)require_answers_of_the_loop(decoded, cube.blob, changed);
            else if (!is_ray) REQUIRE(raycast(cube.blob, changed).status == status);
            return is_ray;
        };
        REQUIRE(is_taken([](Data&) {}));

        for (const std::int32_t bits : {0, 1, 5, 6}) CHECK(is_taken([&](Data& d) { d.fraction_bits = bits; }));
        for (const std::int32_t bits : {-1, 7, 31, 32, least, most})
            CHECK_FALSE(is_taken([&](Data& d) { d.fraction_bits = bits; }));
        for (const int axis : {3, 4, 255})
            CHECK_FALSE(is_taken([&](Data& d) { d.longest_axis = static_cast<std::uint8_t>(axis); }));
        CHECK_FALSE(is_taken([&](Data& d) {
            for (std::int32_t& way : d.direction) way = 0;
            d.longest_axis = 7;  // four words behind the direction: where t_min is
            d.t_min = std::bit_cast<float>(most_units / 2);
        }));

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
        for (const Tau& border : {Tau{&Data::tau_min, std::numeric_limits<float>::max()}, Tau{&Data::tau_max, INFINITY},
                                  Tau{&Data::tau_offset, 0x1p121f}}) {
            const auto with = [&](float value) { return is_taken([&](Data& d) { d.*border.tau = value; }); };
            for (const float value : {0.0f, -0.0f, 0x1p-100f, 1.0f, border.most}) CHECK(with(value));
            for (const float value : {below(0x1p-100f), std::numeric_limits<float>::denorm_min(), -0x1p-100f, -1.0f,
                                      -INFINITY, not_a_number, -not_a_number})
                CHECK_FALSE(with(value));
            CHECK_FALSE(with(std::bit_cast<float>(std::bit_cast<std::uint32_t>(border.most) + 1)));
        }
        CHECK_FALSE(is_taken([&](Data& d) { d.tau_min = INFINITY; }));
        CHECK_FALSE(is_taken([&](Data& d) { d.tau_offset = above(0x1p121f); }));
        for (float Data::*window : {&Data::t_min, &Data::t_max}) {
            for (const float value : {-INFINITY, -1.0f, 0.0f, std::numeric_limits<float>::denorm_min(), INFINITY})
                CHECK(is_taken([&](Data& d) { d.*window = value; }));
            for (const float value : {not_a_number, -not_a_number, std::bit_cast<float>(0x7F800001u)})
                CHECK_FALSE(is_taken([&](Data& d) { d.*window = value; }));
        }
    }
}

TEST_CASE("seams: a rounded ray with a status that round_ray does not leave is refused") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f)), empty(Mesh{});
    const detail::RoundedRayData good =
        round_ray(cube.blob.lattice(), {{0.25f, 0.5f, 5.0f}, {0.0f, 0.0f, -2.0f}}).data();
    for (unsigned status = 0; status < 256; ++status) {
        for (const Blob& blob : {cube.blob, empty.blob}) {
            detail::RoundedRayData data = good;
            data.status = static_cast<QueryStatus>(status);
            const bool is_returned = data.status == QueryStatus::ok || data.status == QueryStatus::out_of_range;
            QueryStatus expected = is_returned ? data.status : QueryStatus::invalid_argument;
            if (expected == QueryStatus::ok && blob.triangle_count() == 0) expected = QueryStatus::not_found;
            CHECK(raycast(blob, std::bit_cast<RoundedRay>(data)).status == expected);
            CHECK(occluded(blob, std::bit_cast<RoundedRay>(data)).status() == expected);
        }
    }
}

TEST_CASE("seams: a ray that may hit nothing is taken whatever else its words are") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f)), empty(Mesh{});
    const RoundedRay good = round_ray(cube.blob.lattice(), {{0.25f, 0.5f, 5.0f}, {0.0f, 0.0f, -2.0f}});
    detail::RoundedRayData data;
    data.region = cube.blob.lattice();
    data.status = QueryStatus::ok;
    data.fraction_bits = std::numeric_limits<std::int32_t>::max();
    data.longest_axis = 255;
    for (std::int32_t& origin : data.origin) origin = std::numeric_limits<std::int32_t>::min();
    const auto nothing = std::bit_cast<RoundedRay>(data);
    for (const Blob& blob : {cube.blob, empty.blob}) {
        // Right after one that hits, of which nothing must be left.
        const RayHit before = raycast(blob, good), hit = raycast(blob, nothing);
        CHECK(bool(before) == (blob.triangle_count() != 0));
        CHECK(hit.status == QueryStatus::not_found);
        CHECK(hit.triangle == no_triangle);
        CHECK(hit.t == INFINITY);
        const YesNo was_hit = occluded(blob, good), any = occluded(blob, nothing);
        CHECK(was_hit.yes() == (blob.triangle_count() != 0));
        CHECK(any.no());
    }
}

TEST_CASE("seams: a ray that is rounded at a border of numbers is taken again") {
    BakeOptions options;
    for (const int exponent : {-100, 100}) {
        options.resolution = Resolution::step(exponent);
        const OpenedBlob cube(make_cube(0.0f, std::ldexp(1.0f, exponent + 8)), options);
        const Lattice region = cube.blob.lattice();
        const float least = std::numeric_limits<float>::denorm_min(), most = std::numeric_limits<float>::max();
        for (const float length : {least, std::numeric_limits<float>::min(), 1.0f, most}) {
            const Vec3 origin = {std::ldexp(1.0f, exponent + 7), std::ldexp(1.0f, exponent + 7),
                                 std::ldexp(1.0f, exponent + 9)};
            const RoundedRay rounded = round_ray(region, {origin, {0.0f, 0.0f, -length}});
            REQUIRE(rounded);
            REQUIRE(rounded.data().may_hit == 1);
            CHECK(raycast(cube.blob, rounded));
        }
    }
}

TEST_CASE("seams: a ray from just below 2^120 steps away is rounded and from there on it is out of range") {
    const OpenedBlob cube(make_cube(0.0f, 8.0f), {.resolution = Resolution::step(0)});
    const Lattice region = cube.blob.lattice();
    for (const float sign : {-1.0f, 1.0f}) {
        for (int k = 0; k < 3; ++k) {
            float origin[3] = {4.5f, 4.25f, 4.125f}, direction[3] = {0.0f, 0.0f, 0.0f};
            direction[k] = -sign;
            const auto rounded = [&](float distance) {
                origin[k] = sign * distance;
                return round_ray(region,
                                 {{origin[0], origin[1], origin[2]}, {direction[0], direction[1], direction[2]}});
            };
            CHECK(rounded(0x1p120f).status() == QueryStatus::out_of_range);
            const RoundedRay far = rounded(std::nextafter(0x1p120f, 0.0f));
            CHECK(far.status() == QueryStatus::ok);
            CHECK(raycast(cube.blob, far));
        }
    }
}

TEST_CASE("seams: a region is as long as 2^24 - 1 steps and no longer") {
    const BakeOptions options = {.resolution = Resolution::step(0)};
    const auto placed = [&](int axis, float from, float to) {  // flat where both are the same
        Mesh mesh;
        for (const Vec3& p : {Vec3{from, 0, 0}, Vec3{to, 4, 0}, Vec3{from, 0, 4}})
            mesh.positions.push_back(axis == 0 ? p : axis == 1 ? Vec3{p.z, p.x, p.y} : Vec3{p.y, p.z, p.x});
        mesh.triangles = {{0, 1, 2}};
        return OpenedBlob(mesh, options);
    };
    const auto most = static_cast<float>(most_steps);
    for (int axis = 0; axis < 3; ++axis) {
        const OpenedBlob here = placed(axis, 0, 2), flat = placed(axis, most, most);
        const OpenedBlob last = placed(axis, most - 3, most), beyond = placed(axis, most - 2, most + 1);
        const OpenedBlob beyond_and_flat = placed(axis, most + 1, most + 1), far = placed(axis, 0x1p31f, 0x1p31f);
        const OpenedBlob farther = placed(axis, 0x1p90f, 0x1p90f);
        for (const OpenedBlob* there : {&flat, &last}) {
            const Blob both[] = {there->blob, here.blob};
            const Result<Lattice> found = lattice_of(both);
            REQUIRE(found);
            const Lattice& region = *found;
            CHECK(region.extent[axis] == most_steps);
            CHECK(region.extent[(axis + 1) % 3] == 4);
            float at[3] = {1, 1, 1}, towards[3] = {0, 0, 0};
            at[axis] = most - 9;
            towards[axis] = 1;
            const RoundedRay ray = round_ray(region, {{at[0], at[1], at[2]}, {towards[0], towards[1], towards[2]}});
            CHECK(raycast(there->blob, ray));
            CHECK(raycast(here.blob, ray).status == QueryStatus::not_found);
        }
        for (const OpenedBlob* there : {&beyond, &beyond_and_flat, &far, &farther}) {
            const Blob both[] = {here.blob, there->blob};
            CHECK(lattice_of(both).status == QueryStatus::out_of_range);
            const RoundedRay ray = round_ray(here.blob.lattice(), {{1, 1, 1}, {1, 2, 3}});
            CHECK(raycast(there->blob, ray).status == QueryStatus::out_of_range);
        }
    }
}

}  // namespace
}  // namespace espalier::tests::rounded_ray_borders_test
