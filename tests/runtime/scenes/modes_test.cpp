// The same answers of scenes in every float mode and on every instruction set.
#include "support/testing.hpp"

#include "maker.hpp"
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

struct Answers {
    InScene<RayHit> hit;
    YesNo any;
    std::vector<RayHit> every_hit;
    InScene<ClosestPoint> nearest;
    std::vector<QueryStatus> ends;
    std::vector<InstanceId> instances;
    std::vector<TriangleId> triangles;
    std::vector<InScene<SweepHit>> contacts;

    friend bool same(const Answers& a, const Answers& b) {
        if (!same_bits(*a.hit, *b.hit) || a.hit.instance != b.hit.instance || a.any != b.any) return false;
        if (a.every_hit.size() != b.every_hit.size()) return false;
        for (std::size_t i = 0; i < a.every_hit.size(); ++i)
            if (!same_bits(a.every_hit[i], b.every_hit[i])) return false;
        for (std::size_t i = 0; i < a.contacts.size(); ++i)
            if (!same_bits(*a.contacts[i], *b.contacts[i]) || a.contacts[i].instance != b.contacts[i].instance)
                return false;
        return same_bits(*a.nearest, *b.nearest) && a.nearest.instance == b.nearest.instance && a.ends == b.ends &&
               a.instances == b.instances && a.triangles == b.triangles;
    }
};

Answers ask(const BakedScene& scene, const Questions& q) {
    Answers answers;
    answers.hit = raycast(scene, q.ray);
    answers.any = occluded(scene, q.ray);
    answers.nearest = closest_point(scene, q.point, q.max_distance);
    answers.contacts = {sweep(scene, q.sphere, q.displacement, q.options),
                        sweep(scene, q.box, q.displacement, q.options),
                        sweep(scene, q.turned, q.displacement, q.options),
                        sweep(scene, ConvexHull{q.vertices}, q.displacement, q.options)};
    const auto hit = [&](InstanceId instance, const RayHit& each) {
        answers.instances.push_back(instance);
        answers.every_hit.push_back(each);
    };
    const auto pair = [&](InstanceId instance, TriangleId triangle) {
        answers.instances.push_back(instance);
        answers.triangles.push_back(triangle);
    };
    answers.ends = {for_each_hit(scene, q.ray, hit), for_each_overlap(scene, q.sphere, pair),
                    for_each_overlap(scene, q.box, pair), for_each_overlap(scene, q.cone, pair),
                    for_each_candidate(scene, q.box, [&](InstanceId id) { answers.instances.push_back(id); })};
    return answers;
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
            const Answers expected = ask(test.opened.scene, questions);
            for_each_machine([&] { REQUIRE(same(ask(test.opened.scene, questions), expected)); });
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
