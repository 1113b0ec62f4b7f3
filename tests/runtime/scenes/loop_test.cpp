// Claims about queries over scenes: each answer is that of a loop over all instances in public calls.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include <espalier/scene.hpp>

#include "maker.hpp"
#include "support/base/test_scale.hpp"
#include "support/loops/scene_loop.hpp"

namespace espalier::tests::scenes_loop_test {
namespace {

/// Fails if there is a difference. Returns 1 if something was found, to be counted.
std::size_t checked(const SceneComparison& comparison) {
    REQUIRE_MESSAGE(comparison.fault == nullptr, comparison.fault);
    return comparison.is_found ? 1u : 0u;
}

/// Selects all instances and triangles, or some of either.
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
        for (std::uint64_t i = 0; i < count; ++i) {
            CAPTURE(i);
            found += compare(test.opened.scene, maker, i);
        }
    }
    return found;
}

TEST_CASE("scene: closest and any and every hit equal the loop over all instances") {
    const auto compare = [](const BakedScene& scene, SceneQueryMaker& maker, std::uint64_t i) {
        const Ray ray = maker.ray();
        return checked(compare_rays(scene, ray, any_filter(i, maker.random())));
    };
    CHECK(count_found(11, scaled(2'000), compare) > scaled(2'000));
}

TEST_CASE("scene: rays of any length equal the loop over all instances") {
    const auto compare = [](const BakedScene& scene, SceneQueryMaker& maker, std::uint64_t i) {
        Ray ray = maker.ray();
        const int exponent = maker.random().between(-140, 90);
        ray.direction = {std::ldexp(ray.direction.x, exponent), std::ldexp(ray.direction.y, exponent),
                         std::ldexp(ray.direction.z, exponent)};
        ray.t_max = std::ldexp(ray.t_max, -exponent);
        if (i % 4 == 0) ray.direction.y = std::ldexp(ray.direction.y, -60);
        return ray.direction == Vec3{} ? 0 : checked(compare_rays(scene, ray));
    };
    CHECK(count_found(15, scaled(1'000), compare) > scaled(500));
}

TEST_CASE("scene: closest points equal the loop over all instances") {
    const auto compare = [](const BakedScene& scene, SceneQueryMaker& maker, std::uint64_t i) {
        const Vec3 point = maker.point();
        const float most = i % 2 == 0 ? infinity : maker.sphere().radius;
        const std::uint32_t mask = i % 3 == 0 ? maker.random().below(16) : 0xFFFFFFFF;
        return checked(compare_closest_points(scene, point, most, mask));
    };
    CHECK(count_found(12, scaled(500), compare) > scaled(500));
}

TEST_CASE("scene: overlaps of every shape equal the loop over all instances") {
    const auto compare = [](const BakedScene& scene, SceneQueryMaker& maker, std::uint64_t i) {
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
    CHECK(count_found(13, scaled(100), compare) > scaled(100));
}

TEST_CASE("scene: sweeps of every shape equal the loop over all instances") {
    const auto compare = [](const BakedScene& scene, SceneQueryMaker& maker, std::uint64_t i) {
        std::size_t found = 0;
        maker.make_swept_shapes([&](const auto& shape) {
            const SceneSweepOptions options = maker.sweep_options(any_filter(i, maker.random()));
            found += checked(compare_sweeps(scene, shape, maker.displacement(), options));
        });
        return found;
    };
    CHECK(count_found(14, scaled(100), compare) > scaled(200));
}

}  // namespace
}  // namespace espalier::tests::scenes_loop_test
