// The runtime never touches the heap: not to open, not to answer, not when it is asked nonsense.
#include <doctest/doctest.h>

#include <array>
#include <memory>

#include <espalier/espalier.hpp>

#include "support/blobs/test_blobs.hpp"
#include "support/exercise/exercise.hpp"
#include "support/machine/allocation_counter.hpp"
#include "support/queries/ray_maker.hpp"

using namespace espalier;
using namespace espalier::tests;

TEST_SUITE("heap") {
    TEST_CASE("promise: the counter of allocations counts one") {
        const std::uint64_t before = allocation_count();
        const auto something = std::make_unique<int>(1);
        CHECK(allocation_count() == before + 1);
        CHECK(*something == 1);
    }

    TEST_CASE("promise: opening a blob and every query allocate nothing") {
        std::uint64_t allocations = 0;
        for (const TestBlob& test_blob : small_test_blobs()) {
            Random random(1);
            QueryMaker maker(test_blob.decoded, 1);
            const std::uint64_t before = allocation_count();
            Blob blob;
            const Status status = open(test_blob.opened.bytes, blob);
            Blob refused;
            const Status refusal = open(std::span(test_blob.opened.bytes).first(100), refused);
            exercise(blob, random, 200);
            std::uint32_t found = 0;
            for (int i = 0; i < 200; ++i) {
                const Ray ray = maker.any_ray();
                RayHit hit;
                Nearest nearest;
                const Sphere sphere = maker.sphere();
                found += raycast(blob, ray, hit) ? 1u : 0u;
                found += raycast(blob, ray, hit, [](Triangle) { return true; }) ? 1u : 0u;
                found += occluded(blob, ray) ? 1u : 0u;
                found += raycast(blob, round_ray(lattice_of(blob), ray), hit) == QueryStatus::ok ? 1u : 0u;
                found += overlaps(blob, sphere) ? 1u : 0u;
                found += closest_point(blob, sphere.center, sphere.radius, nearest) ? 1u : 0u;
                std::array<Nearest, 20> few;
                found += closest_triangles(blob, sphere.center, sphere.radius, few) != 0 ? 1u : 0u;
                NearestPair pair;
                const Segment segment = {sphere.center, ray.origin};
                found += closest_to_segment(blob, segment, sphere.radius, pair) == QueryStatus::ok ? 1u : 0u;
                found +=
                    closest_to_box(blob, {sphere.center, ray.origin}, sphere.radius, pair) == QueryStatus::ok ? 1u : 0u;
                bool inside = false;
                found += contains(blob, sphere.center, inside) == QueryStatus::ok && inside ? 1u : 0u;
                signed_distance(blob, sphere.center, sphere.radius, nearest);
                const std::array<Ray, 20> rays = {ray, ray, maker.any_ray()};
                std::array<RayHit, 20> hits;
                std::array<std::uint8_t, 20> answers;
                found += raycast(blob, rays, hits) + occluded(blob, rays, answers) != 0 ? 1u : 0u;
                std::array<OriginalHit, 20> originals;
                found += original_hit(blob, hits, originals) == QueryStatus::ok && originals[0] ? 1u : 0u;
                for_each_hit(blob, ray, [&](const RayHit&) { return ++found, keep_going; });
                for_each_overlap(blob, sphere, [&](Triangle) { return ++found, keep_going; });
                for_each_node(blob, [&](const TreeNode&) { return ++found, NodeVisit::descend; });
                for_each_triangle(blob, [&](Triangle, const Corners&) { return ++found, keep_going; });
            }
            allocations += allocation_count() - before;
            CHECK(status == Status::ok);
            CHECK(refusal == Status::too_short);
            CHECK(found > 0);
        }
        CHECK(allocations == 0);
    }
}
