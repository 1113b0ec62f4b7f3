// Claims about queries over moving scenes: each answer is that of a loop over all instances in public calls.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <espalier/scenes/moving_scene.hpp>

#include "made_scene.hpp"
#include "runtime/scenes/maker.hpp"
#include "support/base/test_scale.hpp"
#include "support/loops/scene_loop.hpp"

namespace espalier::tests::moving_scenes_loop_test {
namespace {

/// Returns a step in which the world holds a scene, and each of its instances in the place of any other.
int step_exponent_for(const BakedScene& scene) {
    const Box bounds = scene.bounds();
    float most = 1.0f;
    for (const float x : {bounds.min.x, bounds.min.y, bounds.min.z, bounds.max.x, bounds.max.y, bounds.max.z})
        most = std::max(std::abs(x), most);
    if (scene.instance_count() != 0 && std::abs(bounds.max.x) < 1e-10f) return -100;
    return std::clamp(std::ilogb(most) - 25, -100, 80);
}

/// A test scene whose instances move: inserted in any order, among others that were moved and removed again.
std::unique_ptr<MadeScene> make_moving(const TestScene& test, std::uint64_t seed) {
    Random random(seed);
    const BakedScene& baked = test.opened.scene;
    auto made = std::make_unique<MadeScene>(2 * baked.instance_count() + 1, step_exponent_for(baked), baked.meshes(),
                                            baked.tiles());
    MovingScene& scene = made->scene;
    REQUIRE(scene);
    std::vector<InstanceHandle> removed;
    std::vector<Movement> movements;
    for (std::uint32_t i = 0; i < baked.instance_count(); ++i) {
        const Instance instance = *instance_at(baked, InstanceId{i});
        const std::size_t meshes = baked.meshes().size();
        if (instance.mesh >= meshes && baked.tiles()[instance.mesh - meshes].instance_count() == 0) continue;
        Instance elsewhere = instance;
        elsewhere.transform = instance_at(baked, InstanceId{random.below(baked.instance_count())})->transform;
        if (random.coin()) {
            const Result<InstanceHandle> other = insert(scene, elsewhere);
            REQUIRE(other);
            removed.push_back(*other);
        }
        const Result<InstanceHandle> handle = insert(scene, random.coin() ? elsewhere : instance);
        REQUIRE(handle);
        movements.push_back({*handle, instance.transform});
        if (random.below(8) == 0) repack(scene);
    }
    for (const InstanceHandle& handle : removed) REQUIRE(remove(scene, handle) == QueryStatus::ok);
    const Filled moved = move(scene, movements);
    REQUIRE(moved.count == movements.size());
    CHECK(scene.must_refit() == !movements.empty());
    refit(scene);
    if (random.coin()) repack(scene);
    return made;
}

std::size_t checked(const SceneComparison& comparison) {
    REQUIRE_MESSAGE(comparison.fault == nullptr, comparison.fault);
    return comparison.is_found ? 1u : 0u;
}

SceneFilter any_filter(std::uint64_t i, Random& random) {
    static const auto keep = [](InstanceId instance, TriangleId triangle) {
        return (instance.index + instance.in_tile + triangle.index) % 3 != 0;
    };
    const std::uint32_t mask = i % 3 == 0 ? random.below(16) : 0xFFFFFFFF;
    return i % 5 == 0 ? SceneFilter(mask, keep) : SceneFilter(mask);
}

/// Calls `compare(scene, maker, i)` for each scene and i below `count`. Returns the sum of the results.
template <class Compare>
std::size_t count_found(std::uint64_t seed, std::uint64_t count, Compare compare) {
    std::size_t found = 0;
    for (const TestScene& test : test_scenes()) {
        CAPTURE(test.name);
        SceneQueryMaker maker(test, seed);
        const std::unique_ptr<MadeScene> made = make_moving(test, seed);
        for (std::uint64_t i = 0; i < count; ++i) {
            CAPTURE(i);
            found += compare(made->scene, maker, i);
        }
    }
    return found;
}

TEST_CASE("scene: rays among moving instances equal the loop over all instances") {
    const auto compare = [](const MovingScene& scene, SceneQueryMaker& maker, std::uint64_t i) {
        const Ray ray = maker.ray();
        return checked(compare_rays(scene, ray, any_filter(i, maker.random())));
    };
    CHECK(count_found(31, scaled(2'000), compare) > scaled(2'000));
}

TEST_CASE("scene: rays of any length among moving instances equal the loop over all instances") {
    const auto compare = [](const MovingScene& scene, SceneQueryMaker& maker, std::uint64_t i) {
        Ray ray = maker.ray();
        const int exponent = maker.random().between(-140, 90);
        ray.direction = {std::ldexp(ray.direction.x, exponent), std::ldexp(ray.direction.y, exponent),
                         std::ldexp(ray.direction.z, exponent)};
        ray.t_max = std::ldexp(ray.t_max, -exponent);
        if (i % 4 == 0) ray.direction.y = std::ldexp(ray.direction.y, -60);
        return ray.direction == Vec3{} ? 0 : checked(compare_rays(scene, ray));
    };
    CHECK(count_found(35, scaled(1'000), compare) > scaled(500));
}

TEST_CASE("scene: closest points of moving instances equal the loop over all instances") {
    const auto compare = [](const MovingScene& scene, SceneQueryMaker& maker, std::uint64_t i) {
        const Vec3 point = maker.point();
        const float most = i % 2 == 0 ? infinity : maker.sphere().radius;
        const std::uint32_t mask = i % 3 == 0 ? maker.random().below(16) : 0xFFFFFFFF;
        return checked(compare_closest_points(scene, point, most, mask));
    };
    CHECK(count_found(32, scaled(500), compare) > scaled(500));
}

TEST_CASE("scene: overlaps of every shape with moving instances equal the loop over all instances") {
    const auto compare = [](const MovingScene& scene, SceneQueryMaker& maker, std::uint64_t i) {
        std::size_t found = 0;
        const auto add = [&](const auto& shape) {
            found += checked(compare_overlaps(scene, shape, any_filter(i, maker.random())));
        };
        add(maker.sphere());
        add(maker.capsule());
        add(maker.box());
        add(maker.oriented_box());
        add(maker.triangle());
        add(maker.cone());
        return found;
    };
    CHECK(count_found(33, scaled(100), compare) > scaled(100));
}

TEST_CASE("scene: sweeps of every shape among moving instances equal the loop over all instances") {
    const auto compare = [](const MovingScene& scene, SceneQueryMaker& maker, std::uint64_t i) {
        std::size_t found = 0;
        maker.make_swept_shapes([&](const auto& shape) {
            const SceneSweepOptions options = maker.sweep_options(any_filter(i, maker.random()));
            found += checked(compare_sweeps(scene, shape, maker.displacement(), options));
        });
        return found;
    };
    CHECK(count_found(34, scaled(100), compare) > scaled(200));
}

}  // namespace
}  // namespace espalier::tests::moving_scenes_loop_test
