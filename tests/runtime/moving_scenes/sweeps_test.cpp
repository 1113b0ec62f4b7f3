// Claims about sweeps of moving scenes: which of the instances that a shape touches at once is the one that counts.
#include "support/testing.hpp"

#include "made_scene.hpp"

namespace espalier::tests::moving_scenes_sweeps_test {
namespace {

TEST_CASE("scene: an instance that is touched at the start comes before one in the first tick of the way") {
    // A corner that is 0.06 steps from the sphere, on a way whose ticks are half a step long.
    Mesh mesh = {.positions = {{8, 1, 0}, {12, 1, 0}, {12, 5, 3}}, .triangles = {{0, 1, 2}}};
    const OpenedBlob baked(mesh, {.resolution = Resolution::step(0)});
    const std::vector<Blob> meshes = {baked.blob};
    MadeScene made(4, -2, meshes);
    Instance touched_later, touched_at_start;
    touched_at_start.transform.translation = {-10, 0, 0};
    REQUIRE(insert(made.scene, touched_later));
    const Sphere sphere = {{}, 8.0f};
    const Vec3 way = {0x1p23f, 0, 0};
    const InScene<SweepHit> alone = sweep(made.scene, sphere, way);
    REQUIRE(alone);
    CHECK(alone->t == 0.0f);
    CHECK_FALSE(alone->starts_overlapping);
    REQUIRE(insert(made.scene, touched_at_start));
    const InScene<SweepHit> both = sweep(made.scene, sphere, way);
    CHECK(both.instance == InstanceId{1});
    CHECK(both->starts_overlapping);
    // Of two that are touched at the start, and of two in the same tick, the one in the lower slot.
    REQUIRE(insert(made.scene, touched_at_start));
    REQUIRE(insert(made.scene, touched_later));
    CHECK(sweep(made.scene, sphere, way).instance == InstanceId{1});
    const auto later = [](InstanceId id, TriangleId) { return id.index == 0 || id.index == 3; };
    CHECK(sweep(made.scene, sphere, way, later).instance == InstanceId{0});
}

}  // namespace
}  // namespace espalier::tests::moving_scenes_sweeps_test
