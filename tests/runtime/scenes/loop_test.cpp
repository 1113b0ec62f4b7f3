// Claims about queries over scenes: each answer is that of a loop over all instances in public calls.
#include <doctest/doctest.h>

#include <cmath>

#include <espalier/scene.hpp>

#include "maker.hpp"
#include "support/base/test_scale.hpp"
#include "support/loops/scene_loop.hpp"

using namespace espalier;
using namespace espalier::tests;

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

}  // namespace

TEST_SUITE("loop") {
    TEST_CASE("scene: closest and any and every hit equal the loop over all instances") {
        std::size_t hits = 0;
        for (const TestScene& test : test_scenes()) {
            CAPTURE(test.name);
            SceneQueryMaker maker(test, 11);
            for (std::uint64_t i = 0; i < scaled(2'000); ++i) {
                CAPTURE(i);
                const Ray ray = maker.ray();
                hits += checked(compare_rays(test.opened.scene, ray, any_filter(i, maker.random())));
            }
        }
        CHECK(hits > scaled(2'000));
    }

    TEST_CASE("scene: rays of any length equal the loop over all instances") {
        std::size_t hits = 0;
        for (const TestScene& test : test_scenes()) {
            CAPTURE(test.name);
            SceneQueryMaker maker(test, 15);
            for (std::uint64_t i = 0; i < scaled(1'000); ++i) {
                Ray ray = maker.ray();
                const int exponent = maker.random().between(-140, 90);
                ray.direction = {std::ldexp(ray.direction.x, exponent), std::ldexp(ray.direction.y, exponent),
                                 std::ldexp(ray.direction.z, exponent)};
                ray.t_max = std::ldexp(ray.t_max, -exponent);
                if (i % 4 == 0) ray.direction.y = std::ldexp(ray.direction.y, -60);
                if (ray.direction == Vec3{}) continue;
                CAPTURE(i);
                hits += checked(compare_rays(test.opened.scene, ray));
            }
        }
        CHECK(hits > scaled(500));
    }

    TEST_CASE("scene: closest points equal the loop over all instances") {
        std::size_t found = 0;
        for (const TestScene& test : test_scenes()) {
            CAPTURE(test.name);
            SceneQueryMaker maker(test, 12);
            for (std::uint64_t i = 0; i < scaled(500); ++i) {
                const Vec3 point = maker.point();
                const float most = i % 2 == 0 ? __builtin_inff() : maker.sphere().radius;
                const std::uint32_t mask = i % 3 == 0 ? maker.random().below(16) : 0xFFFFFFFF;
                CAPTURE(i);
                found += checked(compare_closest_points(test.opened.scene, point, most, mask));
            }
        }
        CHECK(found > scaled(500));
    }

    TEST_CASE("scene: overlaps of every shape equal the loop over all instances") {
        std::size_t found = 0;
        for (const TestScene& test : test_scenes()) {
            CAPTURE(test.name);
            SceneQueryMaker maker(test, 13);
            for (std::uint64_t i = 0; i < scaled(100); ++i) {
                CAPTURE(i);
                const auto compare = [&](const auto& shape) {
                    found += checked(compare_overlaps(test.opened.scene, shape, any_filter(i, maker.random())));
                };
                compare(maker.sphere());
                compare(maker.capsule());
                compare(maker.box());
                compare(maker.oriented_box());
                compare(maker.triangle());
                compare(maker.cone());
            }
        }
        CHECK(found > scaled(100));
    }

    TEST_CASE("scene: sweeps of spheres and capsules equal the loop over all instances") {
        std::size_t found = 0;
        for (const TestScene& test : test_scenes()) {
            CAPTURE(test.name);
            SceneQueryMaker maker(test, 14);
            for (std::uint64_t i = 0; i < scaled(100); ++i) {
                CAPTURE(i);
                const auto compare = [&](const auto& shape, const Vec3& displacement) {
                    const SceneFilter filter = any_filter(i, maker.random());
                    found += checked(compare_sweeps(test.opened.scene, shape, displacement, filter));
                };
                compare(maker.sphere(), maker.displacement());
                compare(maker.capsule(), maker.displacement());
            }
        }
        CHECK(found > scaled(100));
    }
}
