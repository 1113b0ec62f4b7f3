// The same answers of scenes in every float mode and on every instruction set.
#include "support/testing.hpp"

#include "maker.hpp"
#include "platform/scene_answers.hpp"
#include "support/machine/chosen_instruction_set.hpp"
#include "support/machine/float_mode.hpp"

namespace espalier::tests::modes_test {
namespace {

/// Arguments of one query of each kind.
struct Questions {
    Ray ray;
    Vec3 point;
    float max_distance;
    Sphere sphere;
    Box box;
    Cone cone;
    Vec3 displacement;
    OrientedBox turned;
    std::vector<Vec3> vertices;
    SceneSweepOptions options;
};

/// Returns a hash of every answer's bits.
std::uint64_t ask(const BakedScene& scene, const Questions& q) {
    platform::Fingerprint all;
    platform::add_hit(all, raycast(scene, q.ray));
    platform::add_answer(all, occluded(scene, q.ray));
    const InScene<ClosestPoint> nearest = closest_point(scene, q.point, q.max_distance);
    platform::add_place(all, nearest);
    all.add(nearest->distance, nearest->u, nearest->v, nearest->point, nearest->face_normal, nearest->on_shape,
            static_cast<std::uint32_t>(nearest->feature), static_cast<std::uint32_t>(nearest->side));
    platform::add_hit(all, sweep(scene, q.sphere, q.displacement, q.options));
    platform::add_hit(all, sweep(scene, q.box, q.displacement, q.options));
    platform::add_hit(all, sweep(scene, q.turned, q.displacement, q.options));
    platform::add_hit(all, sweep(scene, ConvexHull{q.vertices}, q.displacement, q.options));
    const auto hit = [&](InstanceId instance, const RayHit& each) {
        platform::add_hit(all, InScene<RayHit>{each, instance});
        all.add(static_cast<std::uint32_t>(each.side));
    };
    const auto pair = [&](InstanceId instance, TriangleId triangle) {
        all.add(instance.index, instance.in_tile, triangle.index);
    };
    const auto candidate = [&](InstanceId instance) { all.add(instance.index, instance.in_tile); };
    for (const QueryStatus end : {for_each_hit(scene, q.ray, hit), for_each_overlap(scene, q.sphere, pair),
                                  for_each_overlap(scene, q.box, pair), for_each_overlap(scene, q.cone, pair),
                                  for_each_candidate(scene, q.box, candidate)})
        all.add(end);
    return all.value();
}

Questions questions_of(SceneQueryMaker& maker) {
    constexpr float tiny[] = {1e-40f, 0x1p-149f, -1e-40f, 0.0f, -0.0f, 0x1p-126f, 0x1p-101f};
    Random& random = maker.random();
    const auto small = [&] { return tiny[random.below(7)]; };
    Questions q = {.ray = maker.ray(),
                   .point = maker.point(),
                   .max_distance = maker.sphere().radius,
                   .sphere = maker.sphere(),
                   .box = maker.box(),
                   .cone = maker.cone(),
                   .displacement = maker.displacement(),
                   .turned = maker.oriented_box(),
                   .vertices = maker.hull_vertices(),
                   .options = maker.sweep_options({})};
    const auto kind = random.below(8);
    if (kind == 0)
        q.ray.direction = {q.ray.direction.x * 0x1p120f, q.ray.direction.y * 0x1p120f, q.ray.direction.z * 0x1p120f};
    else if (kind == 1) {
        q.ray.t_min = small();
        q.ray.t_max = small();
    } else if (kind == 2) {
        q.max_distance = small();
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
            const Questions questions = questions_of(maker);
            const std::uint64_t expected = ask(test.opened.scene, questions);
            for_each_machine([&] { REQUIRE(ask(test.opened.scene, questions) == expected); });
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
