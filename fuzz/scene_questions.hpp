// What is asked of a scene, baked or moving: shapes near it, whose answers are those of the loop, and any bits.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

#include <espalier/scene.hpp>
#include <espalier/scenes/moving_scene.hpp>

#include "judge.hpp"
#include "support/base/random.hpp"
#include "support/loops/scene_loop.hpp"

namespace espalier::fuzz {

/// Shapes near a place, from arguments that the fuzzer chooses.
class ShapesNear {
public:
    ShapesNear(const Vec3& center, float size, tests::Random& random)
        : random_(random), center_(center), size_(size > 0x1p-120f ? std::min(size, 0x1p120f) : 0x1p-120f) {}
    ShapesNear(const Box& box, tests::Random& random)
        : ShapesNear({0.5f * box.min.x + 0.5f * box.max.x, 0.5f * box.min.y + 0.5f * box.max.y,
                      0.5f * box.min.z + 0.5f * box.max.z},
                     std::max({box.max.x - box.min.x, box.max.y - box.min.y, box.max.z - box.min.z}), random) {}

    float length() { return random_.unit() * std::ldexp(size_, random_.between(-20, 2)); }
    Vec3 way() { return random_.in_cube(length()); }
    Vec3 point() {
        const Vec3 from = way();
        return {center_.x + from.x, center_.y + from.y, center_.z + from.z};
    }

private:
    tests::Random& random_;
    Vec3 center_;
    float size_;
};

/// Asks the scene everything about shapes that no query refuses for their numbers. Ends the program if the scene is
/// sound and an answer is not that of the loop.
template <class Scene>
void compare_with_loop(const Scene& scene, bool is_sound, ShapesNear shapes, tests::Random& random) {
    const auto judge = [&](const tests::SceneComparison& comparison) {
        if (is_sound && comparison.fault != nullptr) fail("scene", comparison.fault);
    };
    const SceneFilter filter(random.coin() ? 0xFFFFFFFF : random.below(16));
    Ray ray = {shapes.point(), shapes.way()};
    if (ray.direction == Vec3{}) ray.direction.x = 1.0f;
    judge(tests::compare_rays(scene, ray, filter));
    judge(tests::compare_closest_points(scene, shapes.point(), shapes.length(), filter.mask()));
    const Sphere sphere = {shapes.point(), shapes.length()};
    const Capsule capsule = {shapes.point(), shapes.point(), shapes.length()};
    const Vec3 corner = shapes.point();
    const Box box = {corner, {corner.x + shapes.length(), corner.y + shapes.length(), corner.z + shapes.length()}};
    Cone cone = {shapes.point(), shapes.way(), shapes.length()};
    if (cone.axis == Vec3{}) cone.axis.y = 1.0f;
    judge(tests::compare_overlaps(scene, sphere, filter));
    judge(tests::compare_overlaps(scene, capsule, filter));
    judge(tests::compare_overlaps(scene, box, filter));
    judge(tests::compare_overlaps(scene, OrientedBox{corner, {shapes.way(), shapes.way(), shapes.way()}}, filter));
    judge(tests::compare_overlaps(scene, Triangle{shapes.point(), shapes.point(), shapes.point()}, filter));
    judge(tests::compare_overlaps(scene, cone, filter));
    const Vec3 vertices[] = {shapes.point(), shapes.point(), shapes.point(), shapes.point(), shapes.point()};
    SceneSweepOptions options;
    options.filter = filter;
    options.culling = static_cast<FaceCulling>(random.below(3));
    options.ignore_leaving = random.coin();
    options.skin = random.coin() ? shapes.length() : 0.0f;
    judge(tests::compare_sweeps(scene, sphere, shapes.way(), options));
    judge(tests::compare_sweeps(scene, capsule, shapes.way(), options));
    judge(tests::compare_sweeps(scene, box, shapes.way(), options));
    judge(tests::compare_sweeps(scene, OrientedBox{corner, {shapes.way(), shapes.way(), shapes.way()}}, shapes.way(),
                                options));
    judge(tests::compare_sweeps(scene, ConvexHull{std::span(vertices).first(random.below(6))}, shapes.way(), options));
}

inline float any_number(tests::Random& random) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(random.next() >> 32));
}
inline Vec3 any_bits(tests::Random& random) {
    const float x = any_number(random), y = any_number(random), z = any_number(random);
    return {x, y, z};
}

/// Asks with any bits: only that nothing breaks counts.
template <class Scene>
void ask_with_any_bits(const Scene& scene, tests::Random& random) {
    const Vec3 a = any_bits(random), b = any_bits(random), c = any_bits(random), d = any_bits(random);
    const auto ignore = [](InstanceId, TriangleId) {};
    static_cast<void>(raycast(scene, Ray{a, b, c.x, c.y}));
    static_cast<void>(occluded(scene, Ray{a, b, c.x, c.y}));
    static_cast<void>(for_each_hit(scene, Ray{a, b}, [](InstanceId, const RayHit&) {}));
    static_cast<void>(closest_point(scene, a, b.x));
    static_cast<void>(for_each_overlap(scene, Sphere{a, b.x}, ignore));
    static_cast<void>(for_each_overlap(scene, Capsule{a, b, c.x}, ignore));
    static_cast<void>(for_each_overlap(scene, Box{a, b}, ignore));
    static_cast<void>(for_each_overlap(scene, OrientedBox{a, {b, c, d}}, ignore));
    static_cast<void>(for_each_overlap(scene, Triangle{a, b, c}, ignore));
    static_cast<void>(for_each_overlap(scene, Cone{a, b, c.x}, ignore));
    static_cast<void>(for_each_candidate(scene, Box{a, b}, [](InstanceId) {}));
    SceneSweepOptions options;
    options.culling = static_cast<FaceCulling>(random.below(256));
    options.ignore_leaving = random.coin();
    options.skin = any_number(random);
    const Vec3 vertices[] = {a, b, c};
    static_cast<void>(sweep(scene, Sphere{a, b.x}, c, options));
    static_cast<void>(sweep(scene, Capsule{a, b, c.x}, d, options));
    static_cast<void>(sweep(scene, Box{a, b}, d, options));
    static_cast<void>(sweep(scene, OrientedBox{a, {b, c, d}}, b, options));
    static_cast<void>(sweep(scene, ConvexHull{vertices}, d, options));
}

}  // namespace espalier::fuzz
