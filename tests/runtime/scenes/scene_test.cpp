// Claims about scenes as the header words them: opening, instances, filters and refusals.
#include "support/testing.hpp"

#include "maker.hpp"

namespace espalier::tests::scenes_scene_test {
namespace {

std::vector<OpenedBlob> one_cube() { return opened_blobs({make_cube(0.0f, 1.0f)}); }

/// The unit cube at x = 0, 10, 20 and so on.
OpenedScene row_of_cubes(std::size_t count) {
    std::vector<Instance> instances(count);
    for (std::size_t i = 0; i < count; ++i) instances[i].transform.translation.x = 10.0f * static_cast<float>(i);
    return {one_cube(), instances};
}

TEST_CASE("scene: instances are those that were given in the order of their sources") {
    for (const TestScene& test : test_scenes()) {
        CAPTURE(test.name);
        const BakedScene& scene = test.opened.scene;
        REQUIRE(scene.instance_count() == test.instances.size());
        std::vector<bool> seen(test.instances.size());
        for (std::uint32_t i = 0; i < scene.instance_count(); ++i) {
            const Result<Instance> instance = instance_at(scene, {i});
            REQUIRE(instance);
            REQUIRE(instance->source < seen.size());
            CHECK_FALSE(seen[instance->source]);
            seen[instance->source] = true;
            const Instance& given = test.instances[instance->source];
            CHECK(instance->transform == given.transform);
            CHECK(instance->mask == given.mask);
            CHECK(instance->user == given.user);
            if (given.mesh < test.blobs.size()) {
                CHECK(mesh_at(scene, {i})->checksum() == test.blobs[given.mesh].blob.checksum());
                CHECK(instance_at(scene, {i, 0}).status == QueryStatus::invalid_argument);
                continue;
            }
            const OpenedScene& tile = test.tiles[given.mesh - test.blobs.size()];
            CHECK(mesh_at(scene, {i}).status == QueryStatus::invalid_argument);
            for (std::uint32_t j = 0; j < tile.scene.instance_count(); ++j) {
                CHECK(instance_at(scene, {i, j})->transform == instance_at(tile.scene, {j})->transform);
                CHECK(mesh_at(scene, {i, j})->checksum() == mesh_at(tile.scene, {j})->checksum());
            }
            CHECK(instance_at(scene, {i, tile.scene.instance_count()}).status == QueryStatus::invalid_argument);
        }
        CHECK(instance_at(scene, {scene.instance_count()}).status == QueryStatus::invalid_argument);
        CHECK(mesh_at(scene, {scene.instance_count()}).status == QueryStatus::invalid_argument);
        CHECK(instance_at(scene, no_instance).status == QueryStatus::invalid_argument);
    }
}

TEST_CASE("scene: equal blobs become one mesh and unused ones are left out") {
    const Mesh cube = make_cube(0.0f, 1.0f);
    const std::vector<OpenedBlob> blobs = opened_blobs({cube, cube, cube, make_torus(8, 6, 2.0, 0.5)});
    std::vector<std::span<const std::byte>> bytes;
    for (const OpenedBlob& blob : blobs) bytes.emplace_back(blob.bytes);
    std::vector<Instance> instances(3);
    for (std::uint32_t i = 0; i < 3; ++i) instances[i].mesh = i;
    const SceneBakeResult baked = bake_scene(bytes, instances);
    REQUIRE(baked);
    CHECK(baked.report.meshes == 1);
    CHECK(baked.report.instances == 3);
    CHECK(baked.report.triangles == 36);
    CHECK(baked.report.mesh_bytes == blobs[0].bytes.size());
    CHECK(baked.report.bytes == baked.bytes.size());
    CHECK(mesh_count_of_scene(baked.bytes) == 1);
    CHECK(bake_scene(bytes, instances).bytes == baked.bytes);
}

TEST_CASE("scene: rays hit instances where they stand and miss between them") {
    const OpenedScene opened = row_of_cubes(20);
    const BakedScene& scene = opened.scene;
    const InScene<RayHit> hit = raycast(scene, {{-1.0f, 0.5f, 0.25f}, {1.0f, 0.0f, 0.0f}});
    CHECK(hit->t == 1.0f);
    CHECK(hit->normal == Vec3{-1.0f, 0.0f, 0.0f});
    CHECK(instance_at(scene, hit.instance)->source == 0);
    const InScene<RayHit> between = raycast(scene, {{41.5f, 0.5f, 0.25f}, {1.0f, 0.0f, 0.0f}});
    CHECK(between->t == 8.5f);
    CHECK(instance_at(scene, between.instance)->source == 5);
    const InScene<RayHit> miss = raycast(scene, {{41.5f, 0.5f, -5.0f}, {0.0f, 0.0f, 1.0f}});
    CHECK_FALSE(miss);
    CHECK(miss->status == QueryStatus::not_found);
    CHECK(miss.instance == no_instance);
    CHECK(overlaps(scene, Box{{41.5f, 0.0f, 0.0f}, {49.5f, 1.0f, 1.0f}}).no());
    CHECK(overlaps(scene, Box{{41.5f, 0.0f, 0.0f}, {50.0f, 1.0f, 1.0f}}).yes());
    const InScene<SweepHit> moved = sweep(scene, Sphere{{5.0f, 0.5f, 0.5f}, 0.5f}, {9.0f, 0.0f, 0.0f});
    CHECK(std::fabs(moved->t - 0.5f) < 0x1p-22f);
    CHECK(moved->normal == Vec3{-1.0f, 0.0f, 0.0f});
    CHECK(closest_point(scene, {15.0f, 0.5f, 0.5f})->distance == 4.0f);
}

TEST_CASE("scene: contacts are the deepest of all instances and need room for those of one") {
    const OpenedScene opened = row_of_cubes(3);
    const BakedScene& scene = opened.scene;
    std::array<InScene<Contact>, 4> contacts;
    std::array<Contact, 4> room;
    const Sphere ball = {{5.5f, 0.5f, 0.5f}, 4.75f};
    const auto find = [&](const Sphere& body, float margin, std::size_t places, std::size_t in_room,
                          const SceneFilter& filter = {}) {
        return find_contacts(scene, body, margin, std::span(contacts).first(places), std::span(room).first(in_room),
                             filter);
    };
    const Filled both = find(ball, 0.5f, 4, 4);
    CHECK(both.status == QueryStatus::output_full);  // the other faces are farther away
    REQUIRE(both.count == 4);
    CHECK(contacts[0].hit.distance == -0.25f);  // of two triangles of each face
    CHECK(contacts[1].hit.distance == -0.25f);
    CHECK(instance_at(scene, contacts[0].instance)->source == 0);
    CHECK(contacts[0].hit.normal == Vec3{1.0f, 0.0f, 0.0f});
    CHECK(contacts[2].hit.distance == -0.25f);
    CHECK(instance_at(scene, contacts[2].instance)->source == 1);
    CHECK(find(ball, 0.5f, 1, 1).status == QueryStatus::output_full);
    CHECK(find(ball, 0.5f, 0, 0).status == QueryStatus::output_full);
    const auto second = [&](InstanceId id, TriangleId triangle) {
        CHECK(triangle == no_triangle);
        return instance_at(scene, id)->source == 1;
    };
    REQUIRE(find(ball, 0.5f, 4, 4, second).count == 4);
    for (const InScene<Contact>& contact : contacts) CHECK(instance_at(scene, contact.instance)->source == 1);
    CHECK(find(ball, 0.5f, 4, 4, 0).count == 0);
    CHECK(find(ball, 0.5f, 4, 3).status == QueryStatus::invalid_argument);
    CHECK(find(ball, -1.0f, 4, 4).status == QueryStatus::invalid_argument);
    CHECK(find(ball, infinity, 4, 4).status == QueryStatus::invalid_argument);
    CHECK(find({ball.center, infinity}, 0.5f, 4, 4).status == QueryStatus::invalid_argument);
    CHECK(find({ball.center, -1.0f}, 0.5f, 4, 4).status == QueryStatus::invalid_argument);
    CHECK(find_contacts(scene, ConvexHull{}, 0.5f, contacts, room).status == QueryStatus::ok);
    CHECK(find_contacts(BakedScene(), ball, 0.5f, contacts, room).status == QueryStatus::not_open);
    CHECK(find_contacts(MovingScene(), ball, 0.5f, contacts, room).status == QueryStatus::not_open);
}

TEST_CASE("scene: masks and filters leave instances and triangles out") {
    std::vector<Instance> instances(3);
    for (std::uint32_t i = 0; i < 3; ++i) {
        instances[i].transform.translation.x = 4.0f * static_cast<float>(i);
        instances[i].mask = 1u << i;
    }
    const OpenedScene opened(one_cube(), instances);
    const BakedScene& scene = opened.scene;
    const Ray ray = {{-1.0f, 0.5f, 0.25f}, {1.0f, 0.0f, 0.0f}};
    CHECK(raycast(scene, ray)->t == 1.0f);
    CHECK(raycast(scene, ray, 6)->t == 5.0f);
    CHECK(raycast(scene, ray, 4)->t == 9.0f);
    CHECK_FALSE(raycast(scene, ray, 0));
    CHECK(raycast(scene, ray, [&](InstanceId id, TriangleId) { return instance_at(scene, id)->source == 2; })->t ==
          9.0f);
    CHECK(occluded(scene, ray, 8).no());
    std::size_t candidates = 0;
    const Box all = scene.bounds();
    CHECK(for_each_candidate(scene, all, [&](InstanceId) { ++candidates; }) == QueryStatus::ok);
    CHECK(candidates == 3);
    CHECK(for_each_candidate(
              scene, all, [](InstanceId) { return Visit::stop; }, 2) == QueryStatus::stopped);
}

TEST_CASE("scene: a query without an answer is refused and never a miss") {
    const OpenedScene opened = row_of_cubes(4);
    const BakedScene& scene = opened.scene;
    const BakedScene closed;
    CHECK(closed.status() == OpenStatus::not_opened);
    const Ray sound = {{0.0f, 0.0f, 5.0f}, {0.0f, 0.0f, 1.0f}};
    CHECK(raycast(closed, sound)->status == QueryStatus::not_open);
    CHECK(occluded(closed, sound).status() == QueryStatus::not_open);
    CHECK(closest_point(closed, {})->status == QueryStatus::not_open);
    CHECK(sweep(closed, Sphere{}, {})->status == QueryStatus::not_open);
    CHECK(overlaps(closed, Sphere{}).status() == QueryStatus::not_open);
    CHECK(instance_at(closed, {0}).status == QueryStatus::not_open);
    CHECK(mesh_at(closed, {0}).status == QueryStatus::not_open);
    for (const float bad : {not_a_number, infinity, -infinity}) {
        CHECK(raycast(scene, {{bad, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}})->status == QueryStatus::invalid_argument);
        CHECK(raycast(scene, {{}, {0.0f, bad, 0.0f}})->status == QueryStatus::invalid_argument);
        CHECK(closest_point(scene, {0.0f, bad, 0.0f})->status == QueryStatus::invalid_argument);
        CHECK(sweep(scene, Sphere{{bad, 0.0f, 0.0f}, 1.0f}, {})->status == QueryStatus::invalid_argument);
        CHECK(sweep(scene, Sphere{}, {0.0f, 0.0f, bad})->status == QueryStatus::invalid_argument);
        CHECK(overlaps(scene, Sphere{{0.0f, bad, 0.0f}, 1.0f}).status() == QueryStatus::invalid_argument);
        CHECK(overlaps(scene, Box{{bad, 0.0f, 0.0f}, {}}).status() == QueryStatus::invalid_argument);
        CHECK(overlaps(scene, Triangle{{}, {bad, 0.0f, 0.0f}, {}}).status() == QueryStatus::invalid_argument);
        CHECK(overlaps(scene, OrientedBox{{}, {{bad, 0, 0}, {}, {}}}).status() == QueryStatus::invalid_argument);
        CHECK(overlaps(scene, Cone{{}, {bad, 0, 0}, 1.0f}).status() == QueryStatus::invalid_argument);
    }
    CHECK(overlaps(scene, Cone{{0.0f, 1e6f, 0.0f}, {}, 1.0f}).status() == QueryStatus::invalid_argument);
    CHECK(raycast(scene, {{}, {}})->status == QueryStatus::invalid_argument);
    CHECK(closest_point(scene, {}, -1.0f)->status == QueryStatus::invalid_argument);
    CHECK(overlaps(scene, Box{{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 1.0f}}).no());
    CHECK(for_each_candidate(scene, Box{{0.0f, 0.0f, 1.0f}, {}}, [](InstanceId) { FAIL("an empty box"); }) ==
          QueryStatus::ok);
    CHECK(overlaps(scene, Sphere{{}, -1.0f}).status() == QueryStatus::invalid_argument);
    CHECK(overlaps(scene, Sphere{{1e3f, 0.0f, 0.0f}, infinity}).yes());
    const InScene<SweepHit> refused = sweep(scene, Sphere{{}, -1.0f}, {});
    CHECK(refused->t == 0.0f);
    CHECK(sweep(scene, Sphere{{0.0f, 50.0f, 0.0f}, 1.0f}, {})->t == 1.0f);
    std::vector<Ray> rays(3, sound);
    std::vector<InScene<RayHit>> hits(2);
    CHECK(raycast(scene, rays, hits).status == QueryStatus::invalid_argument);
    hits.resize(3);
    CHECK(raycast(scene, rays, hits).count == 3);
    CHECK(same_bits(*hits[2], *raycast(scene, sound)));
}

TEST_CASE("scene: a sound argument without finite numbers in an instance is out of its range") {
    std::vector<Instance> instances(1);
    instances[0].transform.scale = 1e-30f;
    const OpenedScene opened(one_cube(), instances);
    const BakedScene& scene = opened.scene;
    const Vec3 far = {1e25f, 0.0f, 0.0f};
    const Ray ray = {far, {-1.0f, 0.0f, 0.0f}};
    const Sphere sphere = {far, 2e25f};
    CHECK(raycast(scene, ray)->status == QueryStatus::out_of_range);
    CHECK(occluded(scene, ray).status() == QueryStatus::out_of_range);
    CHECK(for_each_hit(scene, ray, [](InstanceId, const RayHit&) {}) == QueryStatus::out_of_range);
    CHECK(closest_point(scene, far)->status == QueryStatus::out_of_range);
    CHECK(sweep(scene, Sphere{far, 1.0f}, {-1e25f, 0.0f, 0.0f})->status == QueryStatus::out_of_range);
    CHECK(overlaps(scene, sphere).status() == QueryStatus::out_of_range);
    CHECK(for_each_overlap(scene, sphere, [](InstanceId, TriangleId) {}) == QueryStatus::out_of_range);
}

TEST_CASE("scene: the baker refuses what no scene can hold and names the instance") {
    const std::vector<OpenedBlob> blobs = one_cube();
    const std::vector<std::span<const std::byte>> bytes = {blobs[0].bytes};
    std::vector<Instance> instances(2);
    const auto refusal = [&] {
        const SceneBakeResult baked = bake_scene(bytes, instances);
        CHECK(baked.bytes.empty());
        CHECK(baked.message.find("instance 1") != std::string::npos);
        return baked.status;
    };
    instances[1].mesh = 1;
    CHECK(refusal() == BakeStatus::invalid_mesh);
    instances[1].mesh = 0;
    for (const float bad : {0.0f, -1.0f, not_a_number, infinity}) {
        instances[1].transform.scale = bad;
        CHECK(refusal() == BakeStatus::invalid_mesh);
    }
    instances[1].transform = {{0.0f, 0.0f, 0.0f, 0.0f}, {}, 1.0f};
    CHECK(refusal() == BakeStatus::invalid_mesh);
    instances[1].transform = {{}, {0.0f, infinity, 0.0f}, 1.0f};
    CHECK(refusal() == BakeStatus::invalid_mesh);
    const std::vector<std::byte> damaged(200);
    const std::vector<std::span<const std::byte>> no_blob = {damaged};
    CHECK(bake_scene(no_blob, std::vector<Instance>(1)).status == BakeStatus::invalid_mesh);
}

}  // namespace
}  // namespace espalier::tests::scenes_scene_test
