// Claims about the boxes of eight moving instances, found side by side.
#include "support/testing.hpp"

#include <runtime/moving_scenes/box_tree/steps_box.hpp>

#include "made_scene.hpp"
#include "support/machine/chosen_instruction_set.hpp"

namespace espalier::tests::steps_boxes_test {
namespace {

using namespace espalier::detail;

constexpr unsigned count = EightStepsBoxes::count;
constexpr std::int32_t step_exponent = -12;

/// Makes one number of a place awkward: tiny, huge, zero, infinite or NaN.
Transform awkward_place(Random& random) {
    Transform place = random_place(random);
    const float number = std::array{0.0f,  -0.0f,     std::ldexp(random.signed_unit(), random.between(-149, 127)),
                                    1e30f, -infinity, not_a_number}[random.below(6)];
    float* const numbers[8] = {&place.rotation.x,    &place.rotation.y,    &place.rotation.z,    &place.rotation.w,
                               &place.translation.x, &place.translation.y, &place.translation.z, &place.scale};
    *numbers[random.below(8)] = number;
    return place;
}

PartBounds random_part(Random& random) {
    return {random.in_cube(3.0f),
            {random.unit(), random.unit(), random.unit()},
            random.unit() * 1e-3f,
            random.unit() * 9.0f,
            1.0f};
}

bool is_scale_in_range(float scale) { return scale >= 0x1p-100f && scale <= 0x1p100f; }

TEST_CASE("scene: boxes of eight moving instances have the bits of each alone on every instruction set") {
    Random random(5);
    std::uint64_t groups = 0, found = 0;
    for (std::uint64_t i = 0; i < scaled(20'000); ++i) {
        CAPTURE(i);
        PartBounds parts[count];
        Transform transforms[count];
        EightPlaces places{};
        bool are_ordinary = true;
        for (unsigned k = 0; k < count; ++k) {
            const bool is_awkward = random.below(24) == 0;
            are_ordinary = are_ordinary && !is_awkward;
            parts[k] = random_part(random);
            transforms[k] = is_awkward ? awkward_place(random) : random_place(random);
            places.parts[k] = &parts[random.below(k + 1)];
            places.transforms[k] = &transforms[k];
        }
        on_each_instruction_set([&] {
            EightStepsBoxes boxes;
            const bool are_found = find_steps_boxes_by_best_set(places, step_exponent, boxes);
            if (are_ordinary) {
                ++groups;
                found += are_found ? 1u : 0u;
            }
            for (unsigned k = 0; k < count && are_found; ++k) {
                StepsBox alone{};
                REQUIRE(is_scale_in_range(transforms[k].scale));
                REQUIRE(find_steps_box(*places.parts[k], transforms[k], step_exponent, alone));
                REQUIRE(boxes[k] == alone);
            }
        });
    }
    CHECK(found == groups);
}

TEST_CASE("scene: a batch of several meshes moves as single calls do up to a refused movement") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f)), torus(make_torus(16, 9, 2.0, 0.5));
    const std::vector<Blob> meshes = {cube.blob, torus.blob};
    Random random(6);
    for (std::uint64_t i = 0; i < scaled(400); ++i) {
        CAPTURE(i);
        MadeScene batch(40, -10, meshes), single(40, -10, meshes);
        std::vector<InstanceHandle> handles;
        for (unsigned k = 0; k < 40; ++k) {
            Instance instance;
            instance.mesh = random.below(8) == 0 ? 1 : 0;
            instance.transform = random_place(random);
            handles.push_back(*insert(batch.scene, instance));
            REQUIRE(*insert(single.scene, instance) == handles.back());
        }
        end_step(batch.scene);
        end_step(single.scene);
        const unsigned refused = static_cast<unsigned>(random.below(60));
        std::vector<Movement> movements;
        for (unsigned k = 0; k < 40; ++k) movements.push_back({handles[random.below(40)], random_place(random)});
        if (refused < 40 && refused % 2 == 0) movements[refused].instance.generation += 2;
        if (refused < 40 && refused % 2 == 1) movements[refused].transform.scale = -1.0f;
        const Filled moved = move(batch.scene, movements);
        CHECK(moved.count == (refused < 40 ? refused : 40u));
        CHECK((moved.status == QueryStatus::ok) == (refused >= 40));
        for (std::size_t k = 0; k < moved.count; ++k)
            REQUIRE(move(single.scene, movements[k].instance, movements[k].transform) == QueryStatus::ok);
        refit(batch.scene);
        REQUIRE(snapshot_of(batch.scene) == snapshot_of(single.scene));
    }
}

}  // namespace
}  // namespace espalier::tests::steps_boxes_test
