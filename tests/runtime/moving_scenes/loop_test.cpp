// Claims about queries over scenes, baked ones and ones that move: each answer is that of a loop over all instances in
// public calls.
#include "support/testing.hpp"

#include <algorithm>
#include <memory>

#include "made_scene.hpp"
#include "runtime/scenes/arguments.hpp"

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

/// Selects all instances and triangles, or some of either.
SceneFilter any_filter(std::uint64_t i, Random& random) {
    static const auto keep = [](InstanceId instance, TriangleId triangle) {
        return (instance.index + instance.in_tile + triangle.index) % 3 != 0;
    };
    const std::uint32_t mask = i % 3 == 0 ? random.below(16) : 0xFFFFFFFF;
    return i % 5 == 0 ? SceneFilter(mask, keep) : SceneFilter(mask);
}

/// Calls `compare(scene, maker, i)` for each baked scene and i below `count`, and for the same instances where they
/// move. Each of the two must find more than `least`.
template <class Compare>
void check_scenes(std::uint64_t seed, std::uint64_t count, std::uint64_t least, Compare compare) {
    for (const bool moves : {false, true}) {
        CAPTURE(moves);
        std::size_t found = 0;
        for (const TestScene& test : test_scenes()) {
            CAPTURE(test.name);
            SceneQueryMaker maker(test, seed + moves);
            const std::unique_ptr<MadeScene> made = moves ? make_moving(test, seed + 1) : nullptr;
            for (std::uint64_t i = 0; i < count; ++i) {
                CAPTURE(i);
                found += moves ? compare(made->scene, maker, i) : compare(test.opened.scene, maker, i);
            }
        }
        CHECK(found > least);
    }
}

TEST_CASE("scene: closest and any and every hit equal the loop over all instances") {
    const auto compare = [](const auto& scene, SceneQueryMaker& maker, std::uint64_t i) {
        const Ray ray = maker.ray();
        return checked(compare_rays(scene, ray, any_filter(i, maker.random())));
    };
    check_scenes(11, scaled(2'000), scaled(2'000), compare);
}

TEST_CASE("scene: rays of any length equal the loop over all instances") {
    const auto compare = [](const auto& scene, SceneQueryMaker& maker, std::uint64_t i) {
        Ray ray = maker.ray();
        const int exponent = maker.random().between(-140, 90);
        ray.direction = {std::ldexp(ray.direction.x, exponent), std::ldexp(ray.direction.y, exponent),
                         std::ldexp(ray.direction.z, exponent)};
        ray.t_max = std::ldexp(ray.t_max, -exponent);
        if (i % 4 == 0) ray.direction.y = std::ldexp(ray.direction.y, -60);
        return ray.direction == Vec3{} ? std::size_t{0} : checked(compare_rays(scene, ray));
    };
    check_scenes(13, scaled(1'000), scaled(500), compare);
}

TEST_CASE("scene: closest points equal the loop over all instances") {
    const auto compare = [](const auto& scene, SceneQueryMaker& maker, std::uint64_t i) {
        const Vec3 point = maker.point();
        const float most = i % 2 == 0 ? infinity : maker.sphere().radius;
        const std::uint32_t mask = i % 3 == 0 ? maker.random().below(16) : 0xFFFFFFFF;
        return checked(compare_closest_points(scene, point, most, mask));
    };
    check_scenes(15, scaled(500), scaled(500), compare);
}

TEST_CASE("scene: overlaps of every shape equal the loop over all instances") {
    const auto compare = [](const auto& scene, SceneQueryMaker& maker, std::uint64_t i) {
        std::size_t found = 0;
        some_arguments(maker).for_each_volume([&](const auto& shape) {
            found += checked(compare_overlaps(scene, shape, any_filter(i, maker.random())));
        });
        return found;
    };
    check_scenes(17, scaled(100), scaled(100), compare);
}

TEST_CASE("scene: sweeps of every shape equal the loop over all instances") {
    const auto compare = [](const auto& scene, SceneQueryMaker& maker, std::uint64_t i) {
        std::size_t found = 0;
        some_arguments(maker).for_each_body([&](const auto& shape) {
            const SceneSweepOptions options = maker.sweep_options(any_filter(i, maker.random()));
            found += checked(compare_sweeps(scene, shape, maker.displacement(), options));
        });
        return found;
    };
    check_scenes(19, scaled(100), scaled(200), compare);
}

TEST_CASE("scene: contacts of every body equal the loop over all instances") {
    const auto compare = [](const auto& scene, SceneQueryMaker& maker, std::uint64_t i) {
        const SceneArguments arguments = some_arguments(maker);
        Random& random = maker.random();
        const float margin = random.coin() ? 0.0f : arguments.max_distance;
        const std::size_t places = random.coin() ? 4096 : random.below(6);
        const auto whole = [](InstanceId instance, TriangleId triangle) {
            return triangle == no_triangle && (instance.index ^ instance.in_tile) % 3 != 0;
        };
        std::size_t found = 0;
        const auto compare_body = [&](const auto& body) {
            const SceneFilter filter = i % 3 == 0 ? SceneFilter(random.below(16), whole) : SceneFilter();
            if (margin < infinity) found += checked(compare_contacts(scene, body, margin, places, filter));
        };
        compare_body(arguments.sphere);
        compare_body(arguments.capsule);
        compare_body(arguments.turned);
        compare_body(ConvexHull{arguments.vertices});
        return found;
    };
    // One call of three has a filter, which may leave out all: a sanitizer's scale would make no other.
    const std::uint64_t count = std::max<std::uint64_t>(scaled(8), 2);
    check_scenes(21, count, std::max(scaled(50), 6 * count), compare);
}

}  // namespace
}  // namespace espalier::tests::moving_scenes_loop_test
