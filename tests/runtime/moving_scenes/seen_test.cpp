// Claims about views of a moving scene from places in a world that float32 does not resolve.
#include "support/testing.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

#include <espalier/scenes/pairs.hpp>

#include <runtime/moving_scenes/box_tree/block.hpp>

#include "made_scene.hpp"
#include "oracle/rational.hpp"
#include "runtime/scenes/arguments.hpp"
#include "runtime/scenes/hilly_ground.hpp"

namespace espalier::tests::seen_test {
namespace {

using oracle::Rational;

constexpr std::int32_t grid = 128;                   ///< in steps
constexpr std::int32_t most = (1 << 30) / grid - 1;  ///< of an origin, in units of the grid

double grid_of(int step_exponent) { return std::ldexp(grid, step_exponent); }

/// A scene of cubes with a side of 1.
struct CubeWorld {
    std::vector<OpenedBlob> opened = opened_blobs({make_cube(-0.5f, 0.5f)});
    std::vector<Blob> meshes{opened[0].blob};
    MadeScene made;
    MovingScene& scene = made.scene;

    explicit CubeWorld(int step_exponent, std::uint32_t capacity = 64) : made(capacity, step_exponent, meshes) {}
    [[nodiscard]] MadeScene copy() const { return {scene.bytes(), meshes}; }
};

TEST_CASE("scene: the origin of a view is the place on a grid of 128 steps that is nearest to the given one") {
    Random random(41);
    for (const int exponent : {-100, -10, 0, 3, 80}) {
        CAPTURE(exponent);
        CubeWorld world(exponent);
        CHECK(world.scene.origin() == Vec3d{});
        const double unit = grid_of(exponent);
        for (std::uint64_t i = 0; i < scaled(20'000); ++i) {
            const auto coordinate = [&] {
                const int size = random.between(-70, 23);
                const double part = double{random.signed_unit()} + 0x1p-30 * double{random.signed_unit()};
                return random.below(8) == 0 ? (random.between(-most, most) + 0.25 * random.between(-2, 2)) * unit
                                            : std::ldexp(part, size) * unit;
            };
            const double x = coordinate(), y = coordinate(), z = coordinate();
            const auto nearest = [&](double place) {
                const double units = std::round(place / unit);  // a power of two: exact
                return units == 0.0 ? 0.0 : units * unit;
            };
            const Vec3d expected = {nearest(x), nearest(y), nearest(z)};
            const bool is_in_world = std::abs(expected.x) <= most * unit && std::abs(expected.y) <= most * unit &&
                                     std::abs(expected.z) <= most * unit;
            const MovingScene view = seen_from(world.scene, {x, y, z});
            REQUIRE(static_cast<bool>(view) == is_in_world);
            REQUIRE(view.origin() == (is_in_world ? expected : Vec3d{}));
            // From a view to another one, and back to the world.
            REQUIRE(seen_from(view, {}).origin() == Vec3d{});
        }
    }
}

TEST_CASE("scene: a place beyond the world or that is no number has no view") {
    CubeWorld world(0);
    const double end = std::ldexp(1.0, 30) - 64.0, before = std::nextafter(end, 0.0);
    const double infinite = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(seen_from(world.scene, {before, -before, 0.0}).origin() == Vec3d{most * 128.0, most * -128.0, 0.0});
    for (const double bad : {end, -end, 2.0 * end, 1e300, infinite, -infinite, nan}) {
        CHECK_FALSE(seen_from(world.scene, {bad, 0.0, 0.0}));
        CHECK_FALSE(seen_from(world.scene, {0.0, bad, 0.0}));
        CHECK_FALSE(seen_from(world.scene, {0.0, 0.0, bad}));
    }
    CHECK(seen_from(world.scene, {-0.0, 5e-324, -5e-324}).origin() == Vec3d{});
    CHECK_FALSE(seen_from(MovingScene(), {}));
    CHECK(MovingScene().origin() == Vec3d{});
}

/// A place somewhere in the world, in units of the grid.
struct Origin {
    std::int32_t units[3];

    [[nodiscard]] MovingScene view(const MovingScene& scene) const {
        const double unit = grid_of(scene.step_exponent());
        return seen_from(scene, {units[0] * unit, units[1] * unit, units[2] * unit});
    }
    /// The coordinate k of a place that counts from here, in the world.
    [[nodiscard]] Rational in_world(float coordinate, int k, int step_exponent) const {
        return Rational::of(coordinate) + Rational::of(std::int64_t{units[k]}, step_exponent + 7);
    }
};
Origin random_origin(Random& random, std::int32_t reach) {
    const auto units = [&] { return random.between(-reach, reach); };
    const std::int32_t x = units(), y = units(), z = units();
    return {{x, y, z}};
}

TEST_CASE("scene: a view returns its own transforms as they were given and rounds those of others once") {
    Random random(43);
    CubeWorld world(-10, 1);
    const Origin far = random_origin(random, most / 2);
    const InstanceHandle handle = *insert(world.scene, {});
    for (std::uint64_t i = 0; i < scaled(20'000); ++i) {
        const std::int32_t reach = 1 << random.between(0, 21);
        Origin from = random_origin(random, reach), to = random_origin(random, reach);
        for (int k = 0; k < 3; ++k) from.units[k] += far.units[k], to.units[k] += far.units[k];
        MovingScene view = from.view(world.scene);
        const Transform given = {{0.0f, 0.6f, 0.0f, 0.8f}, random.in_cube(std::ldexp(1.0f, random.between(-40, 15)))};
        REQUIRE(move(view, handle, given) == QueryStatus::ok);
        REQUIRE(instance_at(view, handle)->transform == given);
        const Transform seen = instance_at(to.view(world.scene), handle)->transform;
        REQUIRE(seen.rotation == given.rotation);
        REQUIRE(seen.scale == given.scale);
        const float before[3] = {given.translation.x, given.translation.y, given.translation.z};
        const float after[3] = {seen.translation.x, seen.translation.y, seen.translation.z};
        for (int k = 0; k < 3; ++k) {
            const Rational exact = from.in_world(before[k], k, -10) - to.in_world(0.0f, k, -10);
            if (exact.sign() == 0) REQUIRE(after[k] == 0.0f);
            else REQUIRE(oracle::absolute(oracle::error_in_ulp(after[k], exact)) <= Rational::of(1, -1));
        }
    }
}

TEST_CASE("scene: the box of an instance holds it in the world whichever view placed it") {
    Random random(45);
    constexpr int exponent = -10;
    CubeWorld world(exponent, 1);
    const InstanceHandle handle = *insert(world.scene, {});
    for (std::uint64_t i = 0; i < scaled(5'000); ++i) {
        const Origin from = random_origin(random, most / 2);
        MovingScene view = from.view(world.scene);
        const Vec3 at = random.in_cube(64.0f);
        REQUIRE(move(view, handle, {{}, at}) == QueryStatus::ok);
        // Not more than two steps and the margin around the cube, seen from where it was placed.
        const Box box = *box_of(view, handle);
        const float low[3] = {box.min.x, box.min.y, box.min.z}, high[3] = {box.max.x, box.max.y, box.max.z};
        const float middle[3] = {at.x, at.y, at.z};
        for (int k = 0; k < 3; ++k) {
            REQUIRE(low[k] <= middle[k] - 0.5f);
            REQUIRE(high[k] >= middle[k] + 0.5f);
            REQUIRE(high[k] - low[k] <= 1.0f + 0x1p-8f);
        }
        // From 0 it is the same box, rounded outward.
        const Box far = *box_of(world.scene, handle);
        const float far_low[3] = {far.min.x, far.min.y, far.min.z}, far_high[3] = {far.max.x, far.max.y, far.max.z};
        for (int k = 0; k < 3; ++k) {
            REQUIRE(Rational::of(far_low[k]) <= from.in_world(low[k], k, exponent));
            REQUIRE(Rational::of(far_high[k]) >= from.in_world(high[k], k, exponent));
        }
        REQUIRE(world.copy().scene);
    }
}

TEST_CASE("scene: an instance that leaves the world is refused through every view and in every batch") {
    CubeWorld world(0, 16);
    const double end = most * 128.0;
    MovingScene view = seen_from(world.scene, {end, 0.0, -end});
    std::vector<Movement> movements;
    const Transform within = {{}, {-2.0f, 1.0f, 2.0f}};
    for (int i = 0; i < 9; ++i) movements.push_back({*insert(view, {.transform = within}), within});
    const Bytes before = snapshot_of(world.scene);
    CHECK(insert(view, {.transform = {{}, {64.0f, 0.0f, 0.0f}}}).status == QueryStatus::out_of_range);
    CHECK(move(view, movements[0].instance, {{}, {0.0f, 0.0f, -64.0f}}) == QueryStatus::out_of_range);
    CHECK(snapshot_of(world.scene) == before);
    for (const std::size_t bad : {std::size_t{0}, std::size_t{3}, std::size_t{7}, std::size_t{8}}) {
        std::vector<Movement> batch = movements;
        batch[bad].transform.translation.x = 64.0f;
        const Filled moved = move(view, batch);
        CHECK(moved.status == QueryStatus::out_of_range);
        CHECK(moved.count == bad);
        refit(view);
        CHECK(world.copy().scene);
    }
    CHECK(move(view, movements).count == movements.size());
}

TEST_CASE("scene: one batch through a view leaves the bytes of single movements") {
    Random random(47);
    CubeWorld one_by_one(-8), batch(-8);
    const Origin from = random_origin(random, most / 2);
    MovingScene one_view = from.view(one_by_one.scene), batch_view = from.view(batch.scene);
    std::vector<Movement> movements(40);
    for (Movement& movement : movements) {
        movement.instance = *insert(one_by_one.scene, {});
        REQUIRE(insert(batch.scene, {}));
        movement.transform = {{0.0f, random.unit(), 0.0f, 1.0f}, random.in_cube(100.0f)};
    }
    for (const Movement& movement : movements) REQUIRE(move(one_view, std::span(&movement, 1)).count == 1);
    REQUIRE(move(batch_view, movements).count == movements.size());
    refit(one_view);
    refit(batch_view);
    CHECK(snapshot_of(one_by_one.scene) == snapshot_of(batch.scene));
}

/// The instances of a test scene around a place in a large world, some placed through a view from there, some through
/// views nearby and some from 0, whose translations the view from there rounds.
struct FarScene {
    MadeScene made;
    MovingScene view;

    FarScene(const TestScene& test, int step_exponent, Random& random)
        : made(test.opened.scene.instance_count() + 1, step_exponent, test.opened.scene.meshes(),
               test.opened.scene.tiles()) {
        const BakedScene& baked = test.opened.scene;
        const Origin center = random_origin(random, most / 2);
        view = center.view(made.scene);
        REQUIRE(view);
        for (std::uint32_t i = 0; i < baked.instance_count(); ++i) {
            Instance instance = *instance_at(baked, InstanceId{i});
            const std::size_t meshes = baked.meshes().size();
            if (instance.mesh >= meshes && baked.tiles()[instance.mesh - meshes].instance_count() == 0) continue;
            const std::uint32_t kind = random.below(3);
            Origin from = kind == 2 ? Origin{} : center;
            if (kind == 1)
                for (std::int32_t& units : from.units) units += random.between(-1000, 1000);
            Vec3& at = instance.transform.translation;
            float* const translation[3] = {&at.x, &at.y, &at.z};
            for (int k = 0; k < 3; ++k)
                *translation[k] += std::ldexp(static_cast<float>(center.units[k] - from.units[k]), step_exponent + 7);
            MovingScene through = from.view(made.scene);
            REQUIRE(insert(through, instance));
        }
    }
};

TEST_CASE("scene: queries through a view equal the loop over the instances as they are seen from there") {
    std::size_t found = 0;
    for (const TestScene& test : test_scenes()) {
        CAPTURE(test.name);
        const Box bounds = test.opened.scene.bounds();
        float size = 1.0f;
        for (const float x : {bounds.min.x, bounds.min.y, bounds.min.z, bounds.max.x, bounds.max.y, bounds.max.z})
            size = std::max(std::abs(x), size);
        // From coarse steps, of which the scene is many, to ones that are as large as the scene.
        for (const int bits : {24, 16, 8, 2}) {
            const int exponent = std::ilogb(size) - bits;
            if (exponent > 80 || (test.opened.scene.instance_count() != 0 && std::abs(bounds.max.x) < 1e-10f)) continue;
            CAPTURE(bits);
            Random random(49);
            FarScene far(test, exponent, random);
            REQUIRE(MadeScene(far.made.scene.bytes(), test.opened.scene.meshes(), test.opened.scene.tiles()).scene);
            SceneQueryMaker maker(test, 50);
            for (std::uint64_t i = 0; i < scaled(30); ++i) {
                CAPTURE(i);
                found += checked(compare_rays(far.view, maker.ray()));
                found += checked(compare_closest_points(far.view, maker.point(), infinity));
                const SceneArguments arguments = some_arguments(maker);
                arguments.for_each_volume(
                    [&](const auto& shape) { found += checked(compare_overlaps(far.view, shape)); });
                arguments.for_each_body([&](const auto& shape) {
                    found += checked(compare_sweeps(far.view, shape, maker.displacement(), arguments.options));
                });
            }
        }
    }
    CHECK(found > scaled(4'000));
}

TEST_CASE("scene: a small query meets an instance whose translation a far view has rounded") {
    // Cubes in steps of the world, with as much between two as one is wide. Far from 0 float32 moves them by 32 steps.
    Random random(51);
    const OpenedBlob cube(make_cube(0.0f, 8.0f));
    const std::vector<Blob> meshes = {cube.blob};
    std::size_t found = 0;
    for (std::uint64_t i = 0; i < scaled(2'000); ++i) {
        CAPTURE(i);
        MadeScene made(1, 0, meshes);
        const float apart = std::ldexp(1.0f, 29);
        MovingScene near = seen_from(made.scene, {0.0, 0.0, 0.0}), far = seen_from(made.scene, {-apart, 0.0, apart});
        const Vec3 at = random.in_cube(100.0f);
        REQUIRE(insert(near, {.transform = {{}, at}}));
        const Vec3 seen = instance_at(far, InstanceId{0})->transform.translation;
        for (const float y : {-3.0f, 4.0f, 11.0f}) {
            const Vec3 from = sum(seen, random.in_cube(40.0f)), to = sum(seen, {4.0f, y, 4.0f});
            found += checked(compare_rays(far, Ray::between(from, to)));
            found += checked(compare_closest_points(far, from, 16.0f));
            found += checked(compare_overlaps(far, Sphere{from, 16.0f}));
            found += checked(compare_sweeps(far, Sphere{from, 4.0f}, difference(to, from)));
        }
    }
    CHECK(found > scaled(2'000));
}

TEST_CASE("scene: rays at the borders of tiles pass between none anywhere in a world of 8000 km") {
    constexpr int side = 4;
    const std::vector<OpenedBlob> opened = opened_tile();
    const std::vector<Blob> meshes = {opened[0].blob};
    Random random(53);
    for (const Vec3d& place : {Vec3d{}, Vec3d{130.0, 3.0, -70.0}, Vec3d{100'000.0, 250.0, -99'999.0},
                               Vec3d{-4'100'000.0, -9.0, 4'100'000.0}}) {
        CAPTURE(place.x);
        MadeScene made(side * side, tile_step_exponent, meshes);
        // Each tile through a view of its own: as a traveller met it, who came from anywhere around, or all from afar.
        const bool is_afar = place.x == 100'000.0;
        for (int row = 0; row < side; ++row)
            for (int column = 0; column < side; ++column) {
                const auto away = [&] { return 500.0 * static_cast<double>(random.signed_unit()); };
                const double x = is_afar ? 40'960.0 : away(), z = is_afar ? -40'960.0 : away();
                MovingScene view = seen_from(made.scene, {place.x + x, place.y, place.z + z});
                const Vec3d from = view.origin();
                const Vec3 at = {static_cast<float>(place.x + tile_cells * column - from.x),
                                 static_cast<float>(place.y - from.y),
                                 static_cast<float>(place.z + tile_cells * row - from.z)};
                REQUIRE(insert(view, {.transform = {{}, at}}));
            }
        REQUIRE(MadeScene(made.scene.bytes(), meshes).scene);
        for (int traveller = 0; traveller < 20; ++traveller) {
            CAPTURE(traveller);
            const auto away = [&] { return 1000.0 * static_cast<double>(random.signed_unit()); };
            const double x = away(), y = away(), z = away();
            const MovingScene view = seen_from(made.scene, {place.x + x, place.y + y, place.z + z});
            const Vec3d from = view.origin();
            const Vec3 ground = {static_cast<float>(place.x - from.x), static_cast<float>(place.y - from.y),
                                 static_cast<float>(place.z - from.z)};
            for (std::uint32_t slot = 0; slot < side * side; ++slot)
                REQUIRE(is_on_common_lattice(view, InstanceId{slot}).yes());
            for (std::uint64_t i = 0; i < scaled(2'000); ++i) {
                CAPTURE(i);
                const Ray ray = aimed_at_border(random, side, ground);
                REQUIRE(raycast(view, ray));
                REQUIRE(occluded(view, ray).yes());
                if (i % 16 == 0) checked(compare_rays(view, ray));
            }
        }
    }
}

TEST_CASE("scene: a view from elsewhere and instances placed through one have the largest common region") {
    const std::vector<OpenedBlob> opened = opened_tile();
    const std::vector<Blob> meshes = {opened[0].blob};
    const auto reach_of = [](const MovingScene& scene) {
        return scene.common_lattice() ? scene.common_lattice()->extent[0] / 2 + 1 : 0;
    };
    MadeScene made(4, tile_step_exponent, meshes);
    MovingScene view = seen_from(made.scene, {1000.0, 0.0, 0.0});
    CHECK(made.scene.common_lattice().status == QueryStatus::not_found);
    CHECK(reach_of(view) == 1 << 23);
    const InstanceHandle handle = *insert(made.scene, {});
    CHECK(reach_of(made.scene) == 1 << 17);
    CHECK(reach_of(view) == 1 << 23);
    CHECK(is_on_common_lattice(view, InstanceId{handle.slot}).yes());
    // Also through one that is on no lattice.
    REQUIRE(move(view, handle, {{}, {0.5f * 0x1p-8f, 0.0f, 0.0f}}) == QueryStatus::ok);
    CHECK(reach_of(made.scene) == 1 << 23);
    CHECK_FALSE(is_on_common_lattice(view, InstanceId{handle.slot}).yes());
    REQUIRE(move(view, handle, {}) == QueryStatus::ok);
    CHECK(is_on_common_lattice(view, InstanceId{handle.slot}).yes());
    CHECK(MadeScene(made.scene.bytes(), meshes).scene);
    std::vector<std::byte> bytes = snapshot_of(made.scene);
    bytes[offsetof(detail::BlockHead, common_region)] = std::byte{1};
    CHECK_FALSE(MadeScene(bytes, meshes).scene);
}

TEST_CASE("scene: tiles that a view had to round are not on its common lattice") {
    // The mesh lies so far from its own origin that float32 has every fourth step there, and nearer every other one.
    constexpr float way = 0x1p17f, step = 0x1p-8f;
    Mesh away = make_tile();
    for (Vec3& position : away.positions) position.x += way;
    const std::vector<OpenedBlob> opened = opened_blobs({away}, {.resolution = Resolution::step(tile_step_exponent)});
    const std::vector<Blob> meshes = {opened[0].blob};
    MadeScene made(2, tile_step_exponent, meshes);
    MovingScene view = seen_from(made.scene, {2000.0, 0.0, 0.0});
    const MovingScene elsewhere = seen_from(made.scene, {2100.0, 0.0, 0.0});
    const InstanceHandle rounded = *insert(view, {.transform = {{}, {2 * step - way, 0.0f, 0.0f}}});
    const InstanceHandle exact = *insert(view, {.transform = {{}, {4 * step - way, 0.0f, 0.0f}}});
    for (const InstanceHandle& handle : {rounded, exact}) {
        CAPTURE(handle.slot);
        CHECK(is_on_common_lattice(view, InstanceId{handle.slot}).yes());
        CHECK(is_on_common_lattice(elsewhere, InstanceId{handle.slot}).yes() == (handle == exact));
        for (std::uint64_t i = 0; i < scaled(200); ++i) {
            const float along = 0.25f + 0.0625f * static_cast<float>(i % 56);
            checked(compare_rays(elsewhere, {{along - 100.0f, 9.0f, 3.3f}, {1e-6f, -1.0f, 0.01f}}));
        }
    }
}

TEST_CASE("scene: a view adds nothing to coordinates along axes that it shares with where instances were placed") {
    CubeWorld world(-8);
    const InstanceHandle handle = *insert(world.scene, {.transform = {{}, {-0.0f, 1e-40f, 5.0f}}});
    const Vec3 seen = instance_at(seen_from(world.scene, {0.0, 0.0, 100.0}), handle)->transform.translation;
    CHECK(std::signbit(seen.x));
    CHECK(seen.y == 1e-40f);
    CHECK(seen.z == -95.0f);
}

TEST_CASE("scene: an instance farther from a view than the world is large is refused") {
    CubeWorld world(0);
    MovingScene view = seen_from(world.scene, {most * 128.0, 0.0, 0.0});
    const float far = std::ldexp(1.0f, 30);
    CHECK(insert(view, {.transform = {{}, {-far - 4096.0f, 0.0f, 0.0f}}}).status == QueryStatus::out_of_range);
    CHECK(insert(view, {.transform = {{}, {-far + 4096.0f, 0.0f, 0.0f}}}));
    CHECK(insert(world.scene, {.transform = {{}, {-4224.0f, 0.0f, 0.0f}}}));
}

TEST_CASE("scene: pairs depend neither on the view in use nor on those that placed the instances") {
    Random random(55);
    std::size_t found = 0;
    for (std::uint64_t round = 0; round < scaled(200); ++round) {
        CAPTURE(round);
        // Places that float32 holds from every origin near: whole numbers of 1/16.
        const Origin center = random_origin(random, most / 2);
        CubeWorld alike(-10), mixed(-10);
        for (int i = 0; i < 40; ++i) {
            const auto sixteenths = [&] { return 0.0625f * static_cast<float>(random.between(-64, 64)); };
            const float x = sixteenths(), y = sixteenths(), z = sixteenths();
            Origin from = center;
            for (std::int32_t& units : from.units) units += random.between(-100, 100);
            const auto away = [&](int k) { return 0.125f * static_cast<float>(center.units[k] - from.units[k]); };
            MovingScene view = center.view(alike.scene), other = from.view(mixed.scene);
            REQUIRE(insert(view, {.transform = {{}, {x, y, z}}}));
            REQUIRE(insert(other, {.transform = {{}, {x + away(0), y + away(1), z + away(2)}}}));
        }
        std::vector<InstancePair> expected(1000), pairs(1000);
        for (const bool must_collide : {false, true}) {
            const auto collect = [&](MovingScene scene, std::vector<InstancePair>& out) {
                const auto filled = must_collide ? collect_colliding_pairs(scene, out, WorkLimit(1'000'000))
                                                 : collect_candidate_pairs(scene, out);
                REQUIRE(filled.status == QueryStatus::ok);
                return filled.count;
            };
            const std::size_t count = collect(alike.scene, expected);
            found += count;
            for (const MovingScene& scene : {center.view(alike.scene), mixed.scene, center.view(mixed.scene),
                                             random_origin(random, most).view(mixed.scene)}) {
                REQUIRE(collect(scene, pairs) == count);
                for (std::size_t i = 0; i < count; ++i) REQUIRE(pairs[i] == expected[i]);
            }
        }
    }
    CHECK(found > scaled(1'000));
}

TEST_CASE("scene: a baked scene meets a moving one where it is seen from the view") {
    CubeWorld world(-10);
    std::vector<OpenedBlob> blobs = opened_blobs({make_cube(-0.5f, 0.5f)});
    const OpenedScene baked(blobs, std::vector<Instance>(1));
    MovingScene view = seen_from(world.scene, {100'000.0, 0.0, -50'000.0}),
                elsewhere = seen_from(world.scene, {10.0, 0.0, 0.0});
    REQUIRE(insert(view, {.transform = {{}, {0.75f, 0.0f, 0.0f}}}));
    std::vector<BakedPair> pairs(4);
    CHECK(collect_candidate_pairs(view, baked.scene, pairs).count == 1);
    CHECK(collect_colliding_pairs(view, baked.scene, pairs, WorkLimit(1000)).count == 1);
    CHECK(collect_candidate_pairs(elsewhere, baked.scene, pairs).count == 0);
    CHECK(collect_colliding_pairs(elsewhere, baked.scene, pairs, WorkLimit(1000)).count == 0);
    CHECK(collect_colliding_pairs(world.scene, baked.scene, pairs, WorkLimit(1000)).count == 0);
    // With an origin it is in the coordinates of the source, and met from that origin alone.
    const SceneBakeResult placed = bake_scene(std::array{std::span<const std::byte>(blobs[0].bytes)},
                                              std::array<Instance, 1>(), {std::array{view.origin()}, view.origin()});
    std::vector<Blob> placed_meshes(1);
    const BakedScene far = open_scene(placed.bytes, placed_meshes);
    REQUIRE(far.source_origin() == view.origin());
    CHECK(collect_candidate_pairs(view, far, pairs).count == 1);
    CHECK(collect_colliding_pairs(view, far, pairs, WorkLimit(1000)).count == 1);
    for (const MovingScene& other : {elsewhere, world.scene}) {
        CHECK(collect_candidate_pairs(other, far, pairs).status == QueryStatus::invalid_argument);
        CHECK(collect_colliding_pairs(other, far, pairs, WorkLimit(1000)).status == QueryStatus::invalid_argument);
    }
}

TEST_CASE("scene: a mesh with another pose keeps its instances where the views placed them") {
    CubeWorld world(-10);
    MovingScene view = seen_from(world.scene, {100'000.0, 0.0, -50'000.0});
    const Transform at = {{}, {0.125f, 3.0f, -7.0f}};
    const InstanceHandle handle = *insert(view, {.transform = at});
    const Box before = *box_of(view, handle);
    REQUIRE(move_instances_of(world.scene, 0) == QueryStatus::ok);
    refit(world.scene);
    CHECK(instance_at(view, handle)->transform == at);
    const Box after = *box_of(view, handle);
    CHECK(after.min == before.min);
    CHECK(after.max == before.max);
    CHECK(world.copy().scene);
}

}  // namespace
}  // namespace espalier::tests::seen_test
