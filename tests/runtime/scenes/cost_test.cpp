// What opening and querying a scene take: no heap, and little more stack than the query of a blob.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <espalier/scene.hpp>

#include "arguments.hpp"
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

TEST_CASE("scene: opening and every query allocate nothing") {
    std::uint64_t allocations = 0;
    std::vector<Blob> meshes(32);
    std::vector<BakedScene> tiles(4);
    for_each_query(40, [&](const BakedScene& scene, SceneQueryMaker& maker) {
        const SceneArguments arguments = some_arguments(maker);
        const std::byte* const bytes = detail::data_of(scene).tree.bytes;
        const std::uint64_t before = allocation_count();
        REQUIRE(open_scene({bytes, scene.size()}, meshes, tiles));
        static_cast<void>(ask_everything(scene, arguments));
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
        const auto check = [](const char* query, const StackUse& most) {
            check_stack(std::string("scene, ") + query, most.of_meshes);
            check_stack(std::string("scene of tiles, ") + query, most.of_tiles);
        };
        // Few rays take the deepest way.
        const auto check_ray = [&](const char* name, auto query) {
            const auto measure = [&](const BakedScene& scene, SceneQueryMaker& maker) {
                const Ray ray = maker.ray();
                return stack_use([&] { query(scene, ray); });
            };
            check(name, most_stack(measure, 200));
        };
        const auto check_overlaps = [&](const char* name, auto make) {
            check(name, most_stack([&](const BakedScene& scene, SceneQueryMaker& maker) {
                      const auto shape = make(maker);
                      return stack_use([&] {
                          (void)overlaps(scene, shape);
                          (void)for_each_overlap(scene, shape, [](InstanceId, TriangleId) {});
                      });
                  }));
        };
        const auto check_sweep = [&](const char* name, auto make) {
            check(name, most_stack([&](const BakedScene& scene, SceneQueryMaker& maker) {
                      const auto shape = make(maker);
                      const Vec3 way = maker.displacement();
                      const SceneSweepOptions options = maker.sweep_options({});
                      return stack_use([&] { (void)sweep(scene, shape, way, options)->t; });
                  }));
        };
        const auto reopen = [&](const BakedScene& scene, SceneQueryMaker&) {
            const std::span<const std::byte> bytes(detail::data_of(scene).tree.bytes, scene.size());
            return stack_use([&] { (void)open_scene(bytes, meshes, tiles); });
        };
        check("open_scene", most_stack(reopen, 1));
        check_ray("raycast", [](const BakedScene& scene, const Ray& ray) { (void)raycast(scene, ray)->t; });
        check_ray("occluded", [](const BakedScene& scene, const Ray& ray) { (void)occluded(scene, ray); });
        check_ray("for_each_hit", [](const BakedScene& scene, const Ray& ray) {
            (void)for_each_hit(scene, ray, [](InstanceId, const RayHit&) {});
        });
        check("closest_point", most_stack([](const BakedScene& scene, SceneQueryMaker& maker) {
                  const Vec3 point = maker.point();
                  return stack_use([&] { (void)closest_point(scene, point)->distance; });
              }));
        check_overlaps("overlaps, a sphere", [](SceneQueryMaker& maker) { return maker.sphere(); });
        check_overlaps("overlaps, a capsule", [](SceneQueryMaker& maker) { return maker.capsule(); });
        check_overlaps("overlaps, a box", [](SceneQueryMaker& maker) { return maker.box(); });
        check_overlaps("overlaps, an oriented box", [](SceneQueryMaker& maker) { return maker.oriented_box(); });
        check_overlaps("overlaps, a triangle", [](SceneQueryMaker& maker) { return maker.triangle(); });
        check_overlaps("overlaps, a cone", [](SceneQueryMaker& maker) { return maker.cone(); });
        check_sweep("sweep, a sphere", [](SceneQueryMaker& maker) { return maker.sphere(); });
        check_sweep("sweep, a capsule", [](SceneQueryMaker& maker) { return maker.capsule(); });
        check_sweep("sweep, a box", [](SceneQueryMaker& maker) { return maker.box(); });
        check_sweep("sweep, an oriented box", [](SceneQueryMaker& maker) { return maker.oriented_box(); });
        std::vector<Vec3> vertices;
        check_sweep("sweep, a hull", [&](SceneQueryMaker& maker) {
            vertices = maker.hull_vertices();
            return ConvexHull{vertices};
        });
        check("for_each_candidate", most_stack([](const BakedScene& scene, SceneQueryMaker& maker) {
                  const Box box = maker.box();
                  return stack_use([&] { (void)for_each_candidate(scene, box, [](InstanceId) {}); });
              }));
    });
}

}  // namespace
}  // namespace espalier::tests::cost_test
