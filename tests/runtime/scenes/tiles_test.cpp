// Claims about instances that are moved by whole steps of one lattice: the tiles of a world.
#include "support/testing.hpp"

#include "hilly_ground.hpp"

namespace espalier::tests::tiles_test {
namespace {

/// A ground of so many tiles along each side, in a scene.
struct Ground {
    std::vector<OpenedBlob> blobs;
    std::vector<Instance> instances;
    OpenedScene opened;

    explicit Ground(int side, Vec3 from = {})
        : blobs(opened_tile()), instances(ground(side, 0, tile_cells, from)), opened(blobs, instances) {}
};

TEST_CASE("scene: instances that are moved by whole steps share a lattice") {
    const Ground ground(5);
    const BakedScene& scene = ground.opened.scene;
    const Result<Lattice> lattice = scene.common_lattice();
    CHECK(lattice->step_exponent == -8);
    CHECK(lattice->extent[0] == 5 * tile_cells * 256);
    for (std::uint32_t i = 0; i < scene.instance_count(); ++i) CHECK(is_on_common_lattice(scene, {i}).yes());
    CHECK(is_on_common_lattice(scene, {25}).status() == QueryStatus::invalid_argument);
    CHECK(is_on_common_lattice(BakedScene(), {0}).status() == QueryStatus::not_open);
    CHECK(BakedScene().common_lattice().status == QueryStatus::not_open);
}

TEST_CASE("scene: instances that rotate or scale or move by part of a step share no lattice") {
    std::vector<Instance> instances = Ground(2).instances;
    instances[0].transform.rotation = {0.0f, 1.0f, 0.0f, 0.0f};
    instances[1].transform.scale = 2.0f;
    instances[2].transform.translation.x += 0x1p-9f;
    instances[3].transform.scale = 0.5f;
    const Ground ground(2);
    const OpenedScene apart(ground.blobs, instances);
    CHECK(apart.scene.common_lattice().status == QueryStatus::not_found);
    instances.push_back(Instance{});
    const OpenedScene one(ground.blobs, instances);
    CHECK(one.scene.common_lattice().status == QueryStatus::ok);
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < one.scene.instance_count(); ++i)
        count += is_on_common_lattice(one.scene, {i}).yes() ? 1u : 0u;
    CHECK(count == 1);
}

TEST_CASE("scene: tiles without a lattice and meshes without triangles are on no common lattice") {
    std::vector<OpenedBlob> blobs = Ground(1).blobs;
    const BakeOptions whole = {.resolution = Resolution::step(0), .profile = Profile::balanced};
    blobs.emplace_back(make_tile(), whole);
    blobs.emplace_back(Mesh{});
    std::vector<Instance> turned(1);
    turned[0].transform.rotation = {0.1f, 0.2f, 0.3f, 0.9f};
    std::vector<OpenedScene> tiles;
    tiles.emplace_back(blobs, turned);
    REQUIRE_FALSE(tiles[0].scene.common_lattice());
    std::vector<Instance> instances(3);
    for (std::uint32_t i = 0; i < 3; ++i) instances[i].mesh = 1 + i;
    const OpenedScene world(blobs, instances, tiles);
    REQUIRE(world.scene.common_lattice());
    REQUIRE(world.scene.common_lattice()->step_exponent == 0);
    for (std::uint32_t i = 0; i < 3; ++i)
        CHECK(is_on_common_lattice(world.scene, {i}).yes() == (instance_at(world.scene, {i})->source == 0));
}

TEST_CASE("scene: a rounded ray moves by whole steps that float32 subtracts exactly and no others") {
    const Ground ground(1);
    const Ray down = {{1.3f, 9.0f, 1.4f}, {0.0f, -1.0f, 0.0f}};
    const auto status_of = [&](const Transform& transform, float origin = 0.0f) {
        Lattice region = ground.blobs[0].blob.lattice();
        region.origin = {origin, origin, origin};
        const RoundedRay ray = round_ray(region, down);
        REQUIRE(ray);
        return to_local(transform, ray).status();
    };
    Transform transform;
    const auto moved = [&transform](float by) {
        transform.translation = {0.0f, 0.0f, by};
        return transform;
    };
    CHECK(status_of(moved(64.0f)) == QueryStatus::ok);
    CHECK(status_of(moved(64.0f), 4.0f) == QueryStatus::ok);
    CHECK(status_of(moved(0x1p-9f)) == QueryStatus::invalid_argument);
    // A step beside 2^24, in either order.
    CHECK(status_of(moved(0x1p-8f), 0x1p24f) == QueryStatus::out_of_range);
    CHECK(status_of(moved(0x1p24f), 0x1p-8f) == QueryStatus::out_of_range);
    for (const float bad : {infinity, -infinity, __builtin_nanf("")})
        CHECK(status_of(moved(bad)) == QueryStatus::invalid_argument);
    for (const float w : {0.0f, -0.0f, infinity, __builtin_nanf("")}) {
        transform = {};
        transform.rotation.w = w;
        CHECK(status_of(transform) == QueryStatus::invalid_argument);
    }
    transform.rotation.w = -0.5f;
    CHECK(status_of(transform) == QueryStatus::ok);
    // A stranger's bytes.
    RoundedRay ray = round_ray(ground.blobs[0].blob.lattice(), down);
    auto data = std::bit_cast<detail::RoundedRayData>(ray);
    data.region.origin.z = 0x1p127f;
    CHECK(to_local(moved(-0x1p127f), std::bit_cast<RoundedRay>(data)).status() == QueryStatus::out_of_range);
    data.region.extent[1] = -1;
    CHECK(to_local(moved(0.0f), std::bit_cast<RoundedRay>(data)).status() == QueryStatus::invalid_argument);
}

TEST_CASE("scene: instances outside of the region of a rounded ray round it for themselves") {
    constexpr int side = 2;
    const Ground ground(side);
    Lattice part = ground.blobs[0].blob.lattice();
    const Ray outside = {{1.3f + tile_cells, 9.0f, 1.4f + tile_cells}, {0.0f, -1.0f, 0.0f}};
    const InScene<RayHit> hit = raycast(ground.opened.scene, outside, round_ray(part, outside));
    REQUIRE(hit);
    const Transform place = instance_at(ground.opened.scene, hit.instance)->transform;
    CHECK(same_bits(hit->t, raycast(*mesh_at(ground.opened.scene, hit.instance), to_local(place, outside)).t));
}

TEST_CASE("scene: rays aimed at the borders of tiles pass between none") {
    for (const Vec3 from : {Vec3{}, Vec3{-4096.0f, 512.0f, 12288.0f}}) {
        constexpr int side = 6;
        const Ground ground(side, from);
        Random random(22);
        for (std::uint64_t i = 0; i < scaled(20'000); ++i) {
            const Ray ray = aimed_at_border(random, side, from);
            CAPTURE(i);
            REQUIRE(raycast(ground.opened.scene, ray));
            REQUIRE(occluded(ground.opened.scene, ray).yes());
        }
    }
}

TEST_CASE("scene: rays aimed at the borders of tiles that are scenes pass between none") {
    constexpr int side = 3;
    const Ground tile(2);
    std::vector<OpenedScene> tiles;
    tiles.emplace_back(tile.blobs, tile.instances);
    const OpenedScene world(tile.blobs, ground(side, 1, 2 * tile_cells), tiles);
    CHECK(is_on_common_lattice(world.scene, {0}).yes());
    CHECK(is_on_common_lattice(world.scene, {8, 3}).yes());
    const Ground whole(2 * side);
    Random random(24);
    for (std::uint64_t i = 0; i < scaled(20'000); ++i) {
        const Ray ray = aimed_at_border(random, 2 * side, {});
        CAPTURE(i);
        const InScene<RayHit> hit = raycast(world.scene, ray);
        REQUIRE(hit);
        REQUIRE(hit.instance.in_tile < 4);
        // The same ground without tiles has the same region, so the same rounded ray.
        const InScene<RayHit> in_whole = raycast(whole.opened.scene, ray);
        REQUIRE(hit->t == in_whole->t);
        REQUIRE(occluded(world.scene, ray).yes());
    }
}

TEST_CASE("scene: rays that are rounded for a region far larger than a tile pass between none") {
    // From 2^23 steps on, rays are rounded to whole steps: far more than the slack of a small tile.
    for (const float away : {2048.0f, 16384.0f, 65000.0f}) {
        constexpr int side = 2;
        const Ground piece(1), ground(side);
        std::vector<OpenedScene> tiles;
        tiles.emplace_back(piece.blobs, piece.instances);
        std::vector<Instance> instances = ground.instances;
        instances.push_back(Instance{});
        instances.back().transform.translation = {away, 0.0f, away};
        for (Instance& instance : instances) instance.mesh = 1;
        const OpenedScene world(piece.blobs, instances, tiles);
        REQUIRE(is_on_common_lattice(world.scene, {0, 0}).yes());
        const Lattice region = world.scene.common_lattice().value;
        Random random(26);
        for (std::uint64_t i = 0; i < scaled(10'000); ++i) {
            Ray ray = aimed_at_border(random, side, {});
            ray.origin.x += random.signed_unit() * 0x1p-8f;  // beside it by less than rounding moves the ray
            ray.origin.z += random.signed_unit() * 0x1p-8f;
            CAPTURE(i);
            REQUIRE(raycast(world.scene, ray));
            REQUIRE(occluded(world.scene, ray).yes());
            checked(compare_rays(world.scene, ray));
            // The same region, chosen by the caller of a smaller scene.
            REQUIRE(raycast(ground.opened.scene, ray, round_ray(region, ray)));
        }
    }
}

TEST_CASE("scene: a rounded ray that was refused is refused and one of another lattice is not used") {
    const Ground ground(2);
    const BakedScene& scene = ground.opened.scene;
    const Ray down = {{1.3f, 9.0f, 1.4f}, {0.0f, -1.0f, 0.0f}}, up = {{1.3f, 9.0f, 1.4f}, {0.0f, 1.0f, 0.0f}};
    for (const Ray& ray : {down, up}) {
        CHECK(raycast(scene, ray, RoundedRay())->status == QueryStatus::invalid_argument);
        CHECK(occluded(scene, ray, RoundedRay()).status() == QueryStatus::invalid_argument);
        const auto fail = [](InstanceId, const RayHit&) { FAIL("a hit of a refused ray"); };
        CHECK(for_each_hit(scene, ray, RoundedRay(), fail) == QueryStatus::invalid_argument);
    }
    Lattice coarse = scene.common_lattice().value;
    coarse.step_exponent += 1;
    const InScene<RayHit> hit = raycast(scene, down, round_ray(coarse, down));
    REQUIRE(hit);
    const Transform place = instance_at(scene, hit.instance)->transform;
    CHECK(same_bits(hit->t, raycast(*mesh_at(scene, hit.instance), to_local(place, down)).t));
}

TEST_CASE("scene: several scenes that take one rounded ray leave no gap between them") {
    constexpr int side = 2;
    const Ground left(side), right(side, {static_cast<float>(side * tile_cells), 0.0f, 0.0f});
    Lattice both = left.opened.scene.common_lattice().value;
    both.extent[0] *= 2;
    Random random(25);
    for (std::uint64_t i = 0; i < scaled(5'000); ++i) {
        const Ray ray = aimed_at_border(random, side, {static_cast<float>(tile_cells), 0.0f, 0.0f});
        const RoundedRay rounded = round_ray(both, ray);
        CAPTURE(i);
        const bool hits_left = static_cast<bool>(raycast(left.opened.scene, ray, rounded));
        const bool hits_right = static_cast<bool>(raycast(right.opened.scene, ray, rounded));
        REQUIRE((hits_left || hits_right));
        REQUIRE(occluded(left.opened.scene, ray, rounded).yes() == hits_left);
        std::size_t listed = 0;
        const auto count = [&](InstanceId, const RayHit&) { ++listed; };
        REQUIRE(for_each_hit(right.opened.scene, ray, rounded, count) == QueryStatus::ok);
        REQUIRE((listed != 0) == hits_right);
    }
}

TEST_CASE("scene: a ground that is moved by whole steps has the same hits") {
    constexpr int side = 4;
    const Ground here(side);
    // Along each axis by 2^20 steps, and along all.
    for (const Vec3 by : {Vec3{4096, 0, 0}, Vec3{0, 4096, 0}, Vec3{0, 0, 4096}, Vec3{1024, -256, 65536}}) {
        CAPTURE(describe(by));
        const Ground there(side, by);
        Random random(23);
        for (std::uint64_t i = 0; i < scaled(5'000); ++i) {
            Ray ray = aimed_at_border(random, side, {});
            // A grid that both places hold exactly.
            for (float* const x : {&ray.origin.x, &ray.origin.y, &ray.origin.z}) *x = std::round(*x * 64.0f) / 64.0f;
            const Ray moved = translated(ray, by);
            const InScene<RayHit> a = raycast(here.opened.scene, ray), b = raycast(there.opened.scene, moved);
            CAPTURE(i);
            REQUIRE(a->status == b->status);
            REQUIRE(a->t == b->t);
            REQUIRE(a->triangle == b->triangle);
            const Result<Instance> at = instance_at(here.opened.scene, a.instance);
            const Result<Instance> at_moved = instance_at(there.opened.scene, b.instance);
            REQUIRE(at.status == at_moved.status);
            if (at) REQUIRE(at->source == at_moved->source);
        }
    }
}

}  // namespace
}  // namespace espalier::tests::tiles_test
