// Claims about the view of a moving scene, as queries and espalier_moving_scene_view() take it: what has no records of
// instances refuses it.
#include "support/testing.hpp"

#include <bit>

#include <espalier/espalier.h>

#include "made_scene.hpp"

namespace espalier::tests::view_test {
namespace {

TEST_CASE("scene: functions of C that read records refuse the view of a moving scene") {
    const SceneParts parts({make_cube(-0.5f, 0.5f)}, {std::vector<Instance>(2)});
    MadeScene made(4, -12, parts.meshes, parts.tiles);
    Instance instance;
    REQUIRE(insert(made.scene, instance));
    instance.mesh = 1;
    REQUIRE(insert(made.scene, instance));
    const auto moving = std::bit_cast<espalier_moving_scene>(made.scene);
    espalier_scene view;
    REQUIRE(espalier_moving_scene_view(&moving, &view) == ESPALIER_QUERY_OK);
    for (const InstanceId id : {InstanceId{0}, InstanceId{1}, InstanceId{1, 0}, InstanceId{2}, no_instance}) {
        const auto of_c = std::bit_cast<espalier_instance_id>(id);
        CHECK(espalier_scene_instance_at(&view, of_c).status == ESPALIER_QUERY_INVALID_ARGUMENT);
        CHECK(espalier_scene_mesh_at(&view, of_c).status == ESPALIER_QUERY_INVALID_ARGUMENT);
        CHECK(espalier_scene_is_on_common_lattice(&view, of_c).status == ESPALIER_QUERY_INVALID_ARGUMENT);
    }
    CHECK(espalier_scene_common_lattice(&view).status == ESPALIER_QUERY_NOT_FOUND);
    const espalier_vec3d origin = espalier_scene_source_origin(&view);
    CHECK(origin.x == 0.0);
}

TEST_CASE("scene: the bounds of a moving scene in the place of a baked one hold its instances") {
    const SceneParts parts({make_cube(-0.5f, 0.5f)});
    MadeScene made(4, -12, parts.meshes);
    const Box nothing = SceneView(made.scene).bounds();
    CHECK(nothing.min.x == 0.0f);
    CHECK(nothing.max.x == 0.0f);
    for (const float x : {-3.0f, 5.0f}) {
        Instance instance = {.transform = {{}, {x, 0.0f, 1.0f}}};
        REQUIRE(insert(made.scene, instance));
    }
    const Box bounds = SceneView(made.scene).bounds();
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
        const Box bounds = SceneView(made.scene).bounds();
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
