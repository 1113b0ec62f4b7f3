#include "refit/mesh_in_scene.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "judge.hpp"
#include "scene_questions.hpp"

namespace espalier::fuzz {

using namespace tests;

namespace {

constexpr std::uint32_t capacity = 4;

float size_of(const Box& range) {
    return std::max({range.max.x - range.min.x, range.max.y - range.min.y, range.max.z - range.min.z, 0x1p-80f});
}

/// Returns the exponent of a step, a thousandth of the mesh or less.
int step_exponent(float size) { return std::clamp(std::ilogb(size) - 12, -100, 80); }

}  // namespace

MeshInScene::MeshInScene(const Deformable& mesh)
    : mesh_(mesh.blob()),
      size_(size_of(mesh.range())),
      memory_(static_cast<std::size_t>(moving_scene_bytes(capacity))),
      scene_(create_moving_scene(memory_.bytes(), capacity, step_exponent(size_), {&mesh_, 1})) {
    require(static_cast<bool>(scene_), "create_moving_scene() has refused its arguments");
    Instance instance;
    static_cast<void>(insert(scene_, instance));
    instance.transform.rotation = {0.5f, -0.25f, 0.125f, 1.0f};
    instance.transform.translation = {size_, 0.25f * size_, 0.0f};
    static_cast<void>(insert(scene_, instance));
    instance.transform.scale = 0.375f;
    static_cast<void>(insert(scene_, instance));
}

void MeshInScene::follow(Random& random) {
    const std::vector<std::byte> before(scene_.bytes().begin(), scene_.bytes().end());
    const QueryStatus status = move_instances_of(scene_, 0);
    if (status != QueryStatus::ok) {
        require(status == QueryStatus::out_of_range, "a pose is refused for another reason than its place");
        require(std::ranges::equal(scene_.bytes(), before), "a refusal has changed the scene");
        return;
    }
    require(scene_.must_refit() == (scene_.slot_end() != 0), "the scene does not wait for its refit");
    static_cast<void>(refit(scene_));
    AlignedBuffer copy(scene_.bytes());
    require(static_cast<bool>(open_moving_scene(copy.bytes(), {&mesh_, 1})), "a copy of the scene does not open");
    compare_with_loop(scene_, true, ShapesNear(mesh_.bounds(), random), random);
}

}  // namespace espalier::fuzz
