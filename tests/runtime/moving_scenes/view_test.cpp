// Claims about a moving scene in the place of a baked one, as queries and espalier_moving_scene_view() take it: what
// has no records of instances refuses it.
#include "support/testing.hpp"

#include <runtime/moving_scenes/queries.hpp>

#include "made_scene.hpp"

namespace espalier::tests::view_test {
namespace {

using detail::MovingSceneQuery;

TEST_CASE("scene: functions that read records refuse a moving scene in the place of a baked one") {
    const SceneParts parts({make_cube(-0.5f, 0.5f)}, {std::vector<Instance>(2)});
    MadeScene made(4, -12, parts.meshes, parts.tiles);
    Instance instance;
    REQUIRE(insert(made.scene, instance));
    instance.mesh = 1;
    REQUIRE(insert(made.scene, instance));
    const MovingSceneQuery query(made.scene);
    const BakedScene& view = query.scene();
    REQUIRE(view);
    for (const InstanceId id : {InstanceId{0}, InstanceId{1}, InstanceId{1, 0}, InstanceId{2}, no_instance}) {
        CHECK(instance_at(view, id).status == QueryStatus::invalid_argument);
        CHECK(mesh_at(view, id).status == QueryStatus::invalid_argument);
        CHECK(is_on_common_lattice(view, id).status() == QueryStatus::invalid_argument);
    }
    CHECK(view.common_lattice().status == QueryStatus::not_found);
}

TEST_CASE("scene: the bounds of a moving scene in the place of a baked one hold its instances") {
    const SceneParts parts({make_cube(-0.5f, 0.5f)});
    MadeScene made(4, -12, parts.meshes);
    const Box nothing = MovingSceneQuery(made.scene).scene().bounds();
    CHECK(nothing.min.x == 0.0f);
    CHECK(nothing.max.x == 0.0f);
    for (const float x : {-3.0f, 5.0f}) {
        Instance instance = {.transform = {{}, {x, 0.0f, 1.0f}}};
        REQUIRE(insert(made.scene, instance));
    }
    const Box bounds = MovingSceneQuery(made.scene).scene().bounds();
    const Box first = *box_of(made.scene, {0, 1}), last = *box_of(made.scene, {1, 1});
    CHECK(bounds.min.x <= first.min.x);
    CHECK(bounds.min.x > first.min.x - 0.1f);  // a multiple of 128 steps
    CHECK(bounds.max.x >= last.max.x);
    CHECK(bounds.max.x < last.max.x + 0.1f);
    CHECK(bounds.max.y >= last.max.y);
    CHECK(bounds.max.z >= last.max.z);
}

TEST_CASE("scene: the bounds of a moving scene far from its origin hold all boxes") {
    const SceneParts parts({make_cube(-0.5f, 0.5f)});
    Random random(5);
    for (int round = 0; round < 200; ++round) {
        MadeScene made(4, -1, parts.meshes);
        const float reach = std::ldexp(1.0f, random.between(10, 28));
        for (int i = 0; i < 4; ++i) {
            Instance instance = {.transform = {{}, random.in_cube(reach), 1.0f + 9.0f * random.unit()}};
            REQUIRE(insert(made.scene, instance));
        }
        const Box bounds = MovingSceneQuery(made.scene).scene().bounds();
        for (std::uint32_t slot = 0; slot < 4; ++slot) {
            const Box box = *box_of(made.scene, {slot, 1});
            CHECK(bounds.min.x <= box.min.x);
            CHECK(bounds.max.x >= box.max.x);
            CHECK(bounds.max.y >= box.max.y);
            CHECK(bounds.max.z >= box.max.z);
        }
    }
}

}  // namespace
}  // namespace espalier::tests::view_test
