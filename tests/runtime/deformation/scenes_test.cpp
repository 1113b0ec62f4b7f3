// Instances of deformable meshes in scenes: after a refit, one call renews their boxes.
#include "support/testing.hpp"

#include "runtime/moving_scenes/made_scene.hpp"
#include "support/blobs/deformed_mesh.hpp"
#include "support/meshes/motions.hpp"

namespace espalier::tests::scenes_test {
namespace {

Transform any_place(Random& random) {
    return {{random.signed_unit(), random.signed_unit(), random.signed_unit(), random.signed_unit()},
            random.in_cube(8.0f),
            0.5f + random.unit()};
}

/// A moving scene of instances of two deformable meshes.
struct DeformingScene {
    explicit DeformingScene(unsigned bits, std::uint64_t seed)
        : cloth(make_plane_grid(8), bits),
          ring(make_torus(12, 6, 2.0, 0.5), bits),
          meshes{cloth.deformable.blob(), ring.deformable.blob()},
          made(40, -12, meshes),
          random(seed) {
        REQUIRE(made.scene);
        for (std::uint32_t i = 0; i < 24; ++i) {
            Instance instance;
            instance.mesh = i % 2;
            instance.transform = any_place(random);
            REQUIRE(insert(made.scene, instance));
        }
        refit(made.scene);
    }

    void move_to(Motion motion, double amount) {
        cloth.move_to(posed(cloth.mesh, motion, amount, random.next()));
        ring.move_to(posed(ring.mesh, motion, amount, random.next()));
        REQUIRE(move_instances_of(made.scene, 0) == QueryStatus::ok);
        REQUIRE(move_instances_of(made.scene, 1) == QueryStatus::ok);
        CHECK(made.scene.must_refit());
        refit(made.scene);
    }

    /// Returns a place on the surface of an instance or anywhere.
    Vec3 place() {
        const Result<Instance> instance = instance_of_number(made.scene, random.below(24));
        const DeformedMesh& mesh = instance->mesh == 0 ? cloth : ring;
        const Vec3 inside = random.in_box(mesh.deformable.blob().bounds());
        return random.below(4) == 0 ? random.in_cube(10.0f) : to_world(instance->transform, inside);
    }

    DeformedMesh cloth, ring;
    std::vector<Blob> meshes;
    MadeScene made;
    Random random;
};

TEST_CASE("deformation: queries of a moving scene equal the loop over its instances in every pose") {
    std::size_t found = 0;
    for (const unsigned bits : {10u, 16u, 22u}) {
        DeformingScene scene(bits, bits);
        for (const Motion motion : every_motion) {
            const std::string name = name_of(motion);
            CAPTURE(bits);
            CAPTURE(name);
            scene.move_to(motion, scene.random.coin() ? 1.0 : 0.4);
            const MovingScene& moving = scene.made.scene;
            for (std::uint64_t i = 0; i < scaled(40); ++i) {
                const Vec3 from = scene.place(), to = scene.place();
                found += checked(compare_rays(moving, Ray{.origin = from, .direction = difference(to, from)}));
                found += checked(compare_closest_points(moving, from, i % 2 == 0 ? 0.5f : infinity));
                found += checked(compare_overlaps(moving, Sphere{to, 0.2f}));
                found += checked(compare_sweeps(moving, Sphere{from, 0.1f}, Vec3{0.5f, -0.5f, to.x}));
            }
        }
    }
    if (asks_enough()) CHECK(found > 1000);
}

TEST_CASE("deformation: a pose that is small in a large range is found in a moving scene") {
    // Numbers of a lattice of many bits round by the size of the range, not of the pose.
    for (const unsigned bits : {16u, 20u, 24u})
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            CAPTURE(bits);
            CAPTURE(seed);
            Random random(seed);
            const float radius = std::ldexp(50e3f, -static_cast<int>(bits));  // about 30 steps
            const Mesh mesh = scaled_by(make_icosphere(1, 1.0, {0.0f, 0.0f, 0.0f}), radius);
            BakeOptions options = deformable_options(mesh, bits);
            options.deformation->range = Box{{-900.0f, -900.0f, -900.0f}, {900.0f, 900.0f, 900.0f}};
            DeformedMesh moving(mesh, options);
            std::vector<Vec3> pose = mesh.positions;
            // Near the local origin, too, where nothing but the range is large.
            const Vec3 center = random.in_cube(seed % 2 == 0 ? radius : 800.0f);
            for (Vec3& p : pose) p = sum(p, center);
            moving.move_to(pose);
            const std::vector<Blob> meshes = {moving.deformable.blob()};
            MadeScene made(4, -20, meshes);  // so fine that boxes are hardly larger
            Instance instance = {.transform = any_place(random)};
            REQUIRE(insert(made.scene, instance));
            refit(made.scene);
            std::size_t found = 0;
            for (std::uint64_t i = 0; i < scaled(60); ++i) {
                const Vec3& vertex = pose[random.below(static_cast<std::uint32_t>(pose.size()))];
                const Vec3 at = to_world(instance.transform, vertex), way = random.in_cube(1.0f);
                found += checked(compare_rays(made.scene, Ray{.origin = difference(at, way), .direction = way}));
                found += checked(compare_overlaps(made.scene, Sphere{at, radius}));
                found += checked(compare_closest_points(made.scene, at, radius));
                // Just beside the vertex that is farthest along an axis.
                float Vec3::*const axis = i % 3 == 0 ? &Vec3::x : i % 3 == 1 ? &Vec3::y : &Vec3::z;
                const float sign = random.coin() ? 1.0f : -1.0f;
                Vec3 beside = to_world(instance.transform, pose.front());
                for (const Vec3& p : pose) {
                    const Vec3 world = to_world(instance.transform, p);
                    if (sign * world.*axis > sign * beside.*axis) beside = world;
                }
                const float by = std::ldexp(1.0f + random.unit(), -static_cast<int>(random.below(12)));
                // By less than half a step apart: the lattice may round them together.
                const float gap = std::ldexp(900.0f, -static_cast<int>(bits)) * random.unit();
                beside.*axis += sign * (by + gap * instance.transform.scale);
                found += checked(compare_overlaps(made.scene, Sphere{beside, by}));
                found += checked(compare_closest_points(made.scene, beside, by));
            }
            if (asks_enough()) CHECK(found > 0);
        }
}

TEST_CASE("deformation: boxes of instances have the margin of the range of motion in every pose") {
    const Mesh mesh = scaled_by(make_icosphere(1, 1.0, {0.0f, 0.0f, 0.0f}), 0x1p-8f);
    BakeOptions options = deformable_options(mesh, 24);
    options.deformation->range = Box{{-900.0f, -900.0f, -900.0f}, {900.0f, 900.0f, 900.0f}};
    DeformedMesh moving(mesh, options);
    const std::vector<Blob> meshes = {moving.deformable.blob()};
    MadeScene made(4, -20, meshes);
    const Result<InstanceHandle> handle = insert(made.scene, Instance{});
    REQUIRE(handle);
    for (const float scale : {1.0f, 0.5f}) {
        moving.move_to(scaled_by(mesh, scale).positions);
        REQUIRE(move_instances_of(made.scene, 0) == QueryStatus::ok);
        refit(made.scene);
        const Box box = *box_of(made.scene, *handle), exact = moving.deformable.blob().bounds();
        CHECK(box.max.x - exact.max.x >= 900.0f * 0x1p-16f);
        CHECK(exact.min.z - box.min.z >= 900.0f * 0x1p-16f);
        CHECK(box.max.x - exact.max.x < 0.1f);
    }
}

TEST_CASE("deformation: a mesh that leaves the world is refused and no box changes") {
    const Mesh mesh = make_plane_grid(4);
    BakeOptions options = deformable_options(mesh);
    options.deformation->range = Box{{-9.0f, -9.0f, -9.0f}, {9.0f, 9.0f, 9.0f}};
    DeformedMesh moving(mesh, options);
    const std::vector<Blob> meshes = {moving.deformable.blob()};
    MadeScene made(8, -20, meshes);
    REQUIRE(made.scene);
    Instance inside, outside;
    // The farthest place, by halves, where the mesh is still in the world.
    for (float by = 0x1p12f; by >= 1.0f; by *= 0.5f) {
        outside.transform.translation.x += by;
        const Result<InstanceHandle> handle = insert(made.scene, outside);
        if (handle) REQUIRE(remove(made.scene, *handle) == QueryStatus::ok);
        else outside.transform.translation.x -= by;
    }
    REQUIRE(insert(made.scene, inside));
    const Result<InstanceHandle> handle = insert(made.scene, outside);
    REQUIRE(handle);
    refit(made.scene);
    const std::vector<std::byte> before(made.bytes().begin(), made.bytes().end());
    const auto is_unchanged = [&] {
        return std::equal(before.begin(), before.end(), made.bytes().begin()) && !made.scene.must_refit();
    };
    CHECK(move_instances_of(made.scene, 1) == QueryStatus::invalid_argument);  // a tile or nothing
    MovingScene none;
    CHECK(move_instances_of(none, 0) == QueryStatus::not_open);
    CHECK(is_unchanged());
    std::vector<Vec3> pose = moving.mesh.positions;
    for (Vec3& p : pose) p.x = moving.deformable.range().max.x;
    moving.move_to(pose);
    REQUIRE(pose.front().x > 2.0f);
    CHECK(move_instances_of(made.scene, 0) == QueryStatus::out_of_range);
    CHECK(is_unchanged());
    REQUIRE(remove(made.scene, *handle) == QueryStatus::ok);
    CHECK(move_instances_of(made.scene, 0) == QueryStatus::ok);
    CHECK(made.scene.must_refit());
}

TEST_CASE("deformation: instances that deform collide as pairs of their meshes do") {
    for (const unsigned bits : {12u, 20u}) {
        DeformingScene scene(bits, 50 + bits);
        for (const Motion motion : {Motion::twist, Motion::collapse, Motion::noise}) {
            scene.move_to(motion, 1.0);
            const MovingScene& moving = scene.made.scene;
            std::size_t expected = 0;
            for (std::uint32_t i = 0; i < 24; ++i)
                for (std::uint32_t j = i + 1; j < 24; ++j) {
                    const Instance a = *instance_of_number(moving, i), b = *instance_of_number(moving, j);
                    const PlacedBlob first(scene.meshes[a.mesh], a.transform);
                    const PlacedBlob second(scene.meshes[b.mesh], b.transform);
                    expected += overlaps(first, second, WorkLimit::unlimited()).yes() ? 1u : 0u;
                }
            std::vector<InstancePair> pairs(300);
            const auto found = collect_colliding_pairs(scene.made.scene, pairs, WorkLimit::unlimited());
            REQUIRE(found.status == QueryStatus::ok);
            CHECK(found.count == expected);
        }
    }
}

}  // namespace
}  // namespace espalier::tests::scenes_test
