// The runtime never touches the heap: not to open, not to answer, not when it is asked nonsense.
#include "support/testing.hpp"

#include <memory>

#include "support/blobs/deformed_mesh.hpp"
#include "support/exercise/exercise.hpp"
#include "support/machine/aligned_buffer.hpp"
#include "support/machine/allocation_counter.hpp"
#include "support/meshes/motions.hpp"

namespace espalier::tests::heap_test {
namespace {

TEST_CASE("promise: the counter of allocations counts one") {
    const std::uint64_t before = allocation_count();
    const auto something = std::make_unique<int>(1);
    CHECK(allocation_count() == before + 1);
    CHECK(*something == 1);
}

TEST_CASE("promise: opening a blob and every query allocate nothing") {
    std::uint64_t allocations = 0;
    for (const TestBlob& test_blob : small_test_blobs()) {
        Random random(1);
        QueryMaker maker(test_blob.decoded, 1);
        const std::uint64_t before = allocation_count();
        const Blob blob = open(test_blob.opened.bytes);
        const Blob refused = open(std::span(test_blob.opened.bytes).first(100));
        exercise(blob, random, 200);
        const Ray ray = maker.any_ray();
        const std::array<RayHit, 20> hits = {raycast(blob, ray), raycast(blob, maker.any_ray())};
        std::array<OriginalHit, 20> originals;
        static_cast<void>(original_hit(blob, hits, originals).status);
        allocations += allocation_count() - before;
        CHECK(blob.status() == OpenStatus::ok);
        CHECK(refused.status() == OpenStatus::too_short);
    }
    CHECK(allocations == 0);
}

TEST_CASE("promise: refits of a mesh and of its scene allocate nothing") {
    DeformedMesh mesh(make_torus(12, 8, 3.0, 1.0));
    const std::vector<std::vector<Vec3>> poses = every_pose(mesh.mesh);
    std::vector<Vec3> far_pose = poses[0];
    far_pose[3].x = 1e6f;
    const Blob blob = mesh.deformable.blob();
    AlignedBuffer block(static_cast<std::size_t>(moving_scene_bytes(1)));
    std::vector<std::byte> whole(blob.size());
    Random random(1);
    const std::uint64_t before = allocation_count();
    MovingScene scene = create_moving_scene(block.bytes(), 1, -12, {&blob, 1});
    bool all_are_ok = static_cast<bool>(insert(scene, {}));
    all_are_ok &= static_cast<bool>(create_deformable(mesh.still, mesh.memory));
    for (const std::vector<Vec3>& pose : poses) {
        all_are_ok &= static_cast<bool>(refit(mesh.deformable, pose));
        all_are_ok &= refit(mesh.deformable, far_pose).status == QueryStatus::out_of_range;
        all_are_ok &= seal(mesh.deformable, whole) == QueryStatus::ok;
        all_are_ok &= move_instances_of(scene, 0) == QueryStatus::ok;
        static_cast<void>(refit(scene));
        exercise(blob, random, 5);
    }
    CHECK(allocation_count() == before);
    CHECK(all_are_ok);
}

}  // namespace
}  // namespace espalier::tests::heap_test
