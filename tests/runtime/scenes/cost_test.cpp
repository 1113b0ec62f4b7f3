// What opening and querying a scene take: no heap, and little more stack than the query of a blob.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <espalier/scene.hpp>

#include "maker.hpp"
#include "support/base/sanitized.hpp"
#include "support/machine/allocation_counter.hpp"
#include "support/machine/chosen_instruction_set.hpp"
#include "support/machine/stack_budgets.hpp"
#include "support/machine/stack_use.hpp"

namespace espalier::tests::cost_test {
namespace {

/// Calls `call` with each scene and a maker of shapes, some times over.
template <class Call>
void for_each_query(int times, Call call) {
    for (const TestScene& test : test_scenes()) {
        SceneQueryMaker maker(test, 21);
        for (int i = 0; i < times; ++i) call(test.opened.scene, maker);
    }
}

/// The deepest stack in scenes of meshes alone, and in those with tiles.
struct StackUse {
    std::size_t of_meshes = 0;
    std::size_t of_tiles = 0;
};

template <class Call>
StackUse most_stack(Call call, int times = 20) {
    StackUse most;
    for_each_query(times, [&](const BakedScene& scene, SceneQueryMaker& maker) {
        std::size_t& own = scene.tiles().empty() ? most.of_meshes : most.of_tiles;
        own = std::max(own, call(scene, maker));
    });
    return most;
}

/// The stack of both queries about overlaps with the shapes that `make` makes.
template <class Make>
StackUse most_stack_of_overlaps(Make make) {
    return most_stack([&](const BakedScene& scene, SceneQueryMaker& maker) {
        const auto shape = make(maker);
        return stack_use([&] {
            (void)overlaps(scene, shape);
            (void)for_each_overlap(scene, shape, [](InstanceId, TriangleId) {});
        });
    });
}

/// The stack of sweeps of the shapes that `make` makes, under some options.
template <class Make>
StackUse most_stack_of_sweeps(Make make) {
    return most_stack([&](const BakedScene& scene, SceneQueryMaker& maker) {
        const auto shape = make(maker);
        const Vec3 way = maker.displacement();
        const SceneSweepOptions options = maker.sweep_options({});
        return stack_use([&] { (void)sweep(scene, shape, way, options)->t; });
    });
}

template <class Query>
StackUse most_stack_of_rays(Query query) {
    const auto measure = [&](const BakedScene& scene, SceneQueryMaker& maker) {
        const Ray ray = maker.ray();
        return stack_use([&] { query(scene, ray); });
    };
    return most_stack(measure, 40);  // few of them take the deepest way
}

TEST_CASE("scene: opening and every query allocate nothing") {
    std::uint64_t allocations = 0;
    std::vector<Blob> meshes(32);
    std::vector<BakedScene> tiles(4);
    for_each_query(40, [&](const BakedScene& scene, SceneQueryMaker& maker) {
        const Ray ray = maker.ray();
        const Sphere sphere = maker.sphere();
        const Capsule capsule = maker.capsule();
        const Vec3 displacement = maker.displacement();
        const Box box = maker.box();
        const OrientedBox turned = maker.oriented_box();
        const std::vector<Vec3> vertices = maker.hull_vertices();
        const SceneSweepOptions options = maker.sweep_options({});
        const std::byte* const bytes = detail::data_of(scene).tree.bytes;
        const std::uint64_t before = allocation_count();
        REQUIRE(open_scene({bytes, scene.size()}, meshes, tiles));
        (void)raycast(scene, ray)->t;
        (void)occluded(scene, ray);
        (void)for_each_hit(scene, ray, [](InstanceId, const RayHit&) {});
        (void)closest_point(scene, sphere.center)->distance;
        (void)overlaps(scene, sphere);
        (void)for_each_overlap(scene, box, [](InstanceId, TriangleId) {});
        (void)for_each_candidate(scene, box, [](InstanceId) {});
        (void)sweep(scene, sphere, displacement, options)->t;
        (void)sweep(scene, capsule, displacement, options)->t;
        (void)sweep(scene, box, displacement, options)->t;
        (void)sweep(scene, turned, displacement, options)->t;
        (void)sweep(scene, ConvexHull{vertices}, displacement, options)->t;
        allocations += allocation_count() - before;
    });
    CHECK(allocations == 0);
}

TEST_CASE("scene: opening and every query stay within their stack budget") {
    if (sanitized) {
        MESSAGE("SKIPPED: the sanitizers give frames other sizes");
        return;
    }
    std::vector<Blob> meshes(32);
    std::vector<BakedScene> tiles(4);
    on_each_instruction_set([&] {
        struct Row {
            const char* query;
            StackUse most;
        };
        const Row rows[] = {
            {"open_scene",
             most_stack(
                 [&](const BakedScene& scene, SceneQueryMaker&) {
                     return stack_use([&] {
                         (void)open_scene({detail::data_of(scene).tree.bytes, scene.size()}, meshes, tiles);
                     });
                 },
                 1)},
            {"raycast",
             most_stack_of_rays([](const BakedScene& scene, const Ray& ray) { (void)raycast(scene, ray)->t; })},
            {"occluded",
             most_stack_of_rays([](const BakedScene& scene, const Ray& ray) { (void)occluded(scene, ray); })},
            {"for_each_hit", most_stack_of_rays([](const BakedScene& scene, const Ray& ray) {
                 (void)for_each_hit(scene, ray, [](InstanceId, const RayHit&) {});
             })},
            {"closest_point", most_stack([](const BakedScene& scene, SceneQueryMaker& maker) {
                 const Vec3 point = maker.point();
                 return stack_use([&] { (void)closest_point(scene, point)->distance; });
             })},
            {"overlaps, a sphere", most_stack_of_overlaps([](SceneQueryMaker& maker) { return maker.sphere(); })},
            {"overlaps, a capsule", most_stack_of_overlaps([](SceneQueryMaker& maker) { return maker.capsule(); })},
            {"overlaps, a box", most_stack_of_overlaps([](SceneQueryMaker& maker) { return maker.box(); })},
            {"overlaps, an oriented box",
             most_stack_of_overlaps([](SceneQueryMaker& maker) { return maker.oriented_box(); })},
            {"overlaps, a triangle", most_stack_of_overlaps([](SceneQueryMaker& maker) { return maker.triangle(); })},
            {"overlaps, a cone", most_stack_of_overlaps([](SceneQueryMaker& maker) { return maker.cone(); })},
            {"sweep, a sphere", most_stack_of_sweeps([](SceneQueryMaker& maker) { return maker.sphere(); })},
            {"sweep, a capsule", most_stack_of_sweeps([](SceneQueryMaker& maker) { return maker.capsule(); })},
            {"sweep, a box", most_stack_of_sweeps([](SceneQueryMaker& maker) { return maker.box(); })},
            {"sweep, an oriented box",
             most_stack_of_sweeps([](SceneQueryMaker& maker) { return maker.oriented_box(); })},
            {"sweep, a hull", most_stack([](const BakedScene& scene, SceneQueryMaker& maker) {
                 const std::vector<Vec3> vertices = maker.hull_vertices();
                 const Vec3 way = maker.displacement();
                 const SceneSweepOptions options = maker.sweep_options({});
                 return stack_use([&] { (void)sweep(scene, ConvexHull{vertices}, way, options)->t; });
             })},
            {"for_each_candidate", most_stack([](const BakedScene& scene, SceneQueryMaker& maker) {
                 const Box box = maker.box();
                 return stack_use([&] { (void)for_each_candidate(scene, box, [](InstanceId) {}); });
             })},
        };
        for (const Row& row : rows) {
            check_stack(std::string("scene, ") + row.query, row.most.of_meshes);
            check_stack(std::string("scene of tiles, ") + row.query, row.most.of_tiles);
        }
    });
}

}  // namespace
}  // namespace espalier::tests::cost_test
