// What opening and querying a scene take: no heap, and little more stack than the query of a blob. The budgets are of
// this machine; those of queries of blobs are in tests/promises/stack_test.cpp.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <espalier/scene.hpp>
#include <runtime/transforms/local_hull.hpp>

#include "maker.hpp"
#include "support/base/sanitized.hpp"
#include "support/machine/allocation_counter.hpp"
#include "support/machine/chosen_instruction_set.hpp"
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
StackUse most_stack(Call call) {
    StackUse most;
    on_each_instruction_set([&] {
        for_each_query(40, [&](const BakedScene& scene, SceneQueryMaker& maker) {
            std::size_t& own = scene.tiles().empty() ? most.of_meshes : most.of_tiles;
            own = std::max(own, call(scene, maker));
        });
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
    return most_stack([&](const BakedScene& scene, SceneQueryMaker& maker) {
        const Ray ray = maker.ray();
        return stack_use([&] { query(scene, ray); });
    });
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
    struct Row {
        const char* query;
        std::size_t budget;
        StackUse most;
        std::size_t of_shape = 0;  ///< of the shape in local space, once more in a tile
    };
    constexpr std::size_t of_a_tile = 1536;  // one more walk
    const Row rows[] = {
        {"open_scene", 3456, most_stack([&](const BakedScene& scene, SceneQueryMaker&) {
             return stack_use([&] {
                 (void)open_scene({detail::data_of(scene).tree.bytes, scene.size()}, meshes, tiles);
             });
         })},
        {"raycast", 4352,
         most_stack_of_rays([](const BakedScene& scene, const Ray& ray) { (void)raycast(scene, ray)->t; })},
        {"occluded", 4096,
         most_stack_of_rays([](const BakedScene& scene, const Ray& ray) { (void)occluded(scene, ray); })},
        {"for_each_hit", 4480, most_stack_of_rays([](const BakedScene& scene, const Ray& ray) {
             (void)for_each_hit(scene, ray, [](InstanceId, const RayHit&) {});
         })},
        {"closest_point", 5632, most_stack([](const BakedScene& scene, SceneQueryMaker& maker) {
             const Vec3 point = maker.point();
             return stack_use([&] { (void)closest_point(scene, point)->distance; });
         })},
        {"overlaps, a sphere", 5376, most_stack_of_overlaps([](SceneQueryMaker& maker) { return maker.sphere(); })},
        {"overlaps, a capsule", 5632, most_stack_of_overlaps([](SceneQueryMaker& maker) { return maker.capsule(); })},
        {"overlaps, a box", 5888, most_stack_of_overlaps([](SceneQueryMaker& maker) { return maker.box(); })},
        {"overlaps, an oriented box", 5888,
         most_stack_of_overlaps([](SceneQueryMaker& maker) { return maker.oriented_box(); })},
        {"overlaps, a triangle", 5120, most_stack_of_overlaps([](SceneQueryMaker& maker) { return maker.triangle(); })},
        {"overlaps, a cone", 5632, most_stack_of_overlaps([](SceneQueryMaker& maker) { return maker.cone(); })},
        {"sweep, a sphere", 9216, most_stack_of_sweeps([](SceneQueryMaker& maker) { return maker.sphere(); })},
        {"sweep, a capsule", 10240, most_stack_of_sweeps([](SceneQueryMaker& maker) { return maker.capsule(); })},
        {"sweep, a box", 10240, most_stack_of_sweeps([](SceneQueryMaker& maker) { return maker.box(); })},
        {"sweep, an oriented box", 10240,
         most_stack_of_sweeps([](SceneQueryMaker& maker) { return maker.oriented_box(); })},
        {"sweep, a hull", 11008, most_stack([](const BakedScene& scene, SceneQueryMaker& maker) {
             const std::vector<Vec3> vertices = maker.hull_vertices();
             const Vec3 way = maker.displacement();
             const SceneSweepOptions options = maker.sweep_options({});
             return stack_use([&] { (void)sweep(scene, ConvexHull{vertices}, way, options)->t; });
         }),
         sizeof(detail::LocalHull)},
        {"for_each_candidate", 896, most_stack([](const BakedScene& scene, SceneQueryMaker& maker) {
             const Box box = maker.box();
             return stack_use([&] { (void)for_each_candidate(scene, box, [](InstanceId) {}); });
         })},
    };
    for (const Row& row : rows) {
        MESSAGE(std::string(row.query), ": ", row.most.of_meshes, " bytes of stack, budget ", row.budget,
                "; with tiles ", row.most.of_tiles);
        CHECK_MESSAGE(row.most.of_meshes <= row.budget, std::string(row.query));
        CHECK_MESSAGE(row.most.of_tiles <= row.budget + of_a_tile + row.of_shape, std::string(row.query));
    }
}

}  // namespace
}  // namespace espalier::tests::cost_test
