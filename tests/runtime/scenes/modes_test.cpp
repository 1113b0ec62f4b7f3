// The same answers of scenes in every float mode and on every instruction set.
#include "support/testing.hpp"

#include "arguments.hpp"
#include "support/machine/chosen_instruction_set.hpp"
#include "support/machine/float_mode.hpp"

namespace espalier::tests::modes_test {
namespace {

/// Also with numbers that are tiny, subnormal or too large.
SceneArguments arguments_of(SceneQueryMaker& maker) {
    constexpr float tiny[] = {1e-40f, 0x1p-149f, -1e-40f, 0.0f, -0.0f, 0x1p-126f, 0x1p-101f};
    Random& random = maker.random();
    const auto small = [&] { return tiny[random.below(7)]; };
    SceneArguments q = some_arguments(maker);
    const auto kind = random.below(8);
    if (kind == 0) q.ray.direction = times(q.ray.direction, 0x1p120f);
    else if (kind == 1) {
        q.ray.t_min = small();
        q.ray.t_max = small();
    } else if (kind == 2) {
        q.max_distance = small();
        q.contact_distance = small();
        q.sphere.radius = small();
        q.options.skin = small();
    } else if (kind == 3) {
        q.box.max.x = q.box.min.x = 0.0f;
        q.box.min.x = 0x1p-149f;
    } else if (kind == 4) {
        q.cone.radius = small();
        q.displacement = {small(), small(), q.displacement.z};
        for (Vec3& vertex : q.vertices) vertex.y = small();
    }
    return q;
}

template <class Change>
void expect_same_answers(Change for_each_machine) {
    for (const std::size_t number : sampled(test_scenes().size(), 3)) {
        const TestScene& test = test_scenes()[number];
        CAPTURE(test.name);
        SceneQueryMaker maker(test, 77);
        for (std::size_t i = 0; i < scaled(400); ++i) {
            CAPTURE(i);
            const SceneArguments arguments = arguments_of(maker);
            const std::uint64_t expected = ask_everything(test.opened.scene, arguments);
            for_each_machine([&] { REQUIRE(ask_everything(test.opened.scene, arguments) == expected); });
        }
    }
}

TEST_CASE("scene: every float mode gives the same answers") {
    expect_same_answers([](auto check) {
        for (const unsigned flags : float_modes) {
            const FloatMode mode(flags);
            CAPTURE(flags);
            check();
        }
    });
}

TEST_CASE("scene: every instruction set gives the same answers and lists the same candidates") {
    expect_same_answers([](auto check) { on_each_instruction_set(check); });
}

}  // namespace
}  // namespace espalier::tests::modes_test
