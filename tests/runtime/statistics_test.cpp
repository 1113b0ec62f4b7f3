// Claims about the instrumented query and about what may be handed in as a visitor.
#include <doctest/doctest.h>

#include <espalier/espalier.hpp>
#include <espalier/statistics.hpp>

#include "../support/mesh_makers.hpp"
#include "../support/profiles.hpp"
#include "../support/query_maker.hpp"
#include "../support/same_bits.hpp"
#include "../support/test_blobs.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

bool is_even(Triangle triangle) { return triangle.index % 2 == 0; }

Visit stop_at_once(Triangle) { return stop; }

}  // namespace

TEST_SUITE("statistics") {
    TEST_CASE("work: the counted query gives the same bits and takes far less than the loop") {
        for (const TestBlob& blob : medium_test_blobs()) {
            CAPTURE(blob.name);
            QueryMaker maker(blob.decoded, 1'000);
            QueryCounters counters;
            const std::uint64_t count = scaled_share(300);
            for (std::uint64_t i = 0; i < count; ++i) {
                const Ray ray = maker.ray(RayKind::incoherent);
                RayHit hit;
                RayHit counted_hit;
                const bool found = raycast(blob.opened.blob, ray, hit);
                REQUIRE(raycast_counted(blob.opened.blob, ray, counted_hit, counters) == found);
                if (found) REQUIRE(same_bits(hit, counted_hit));
            }
            CHECK(counters.nodes >= count / 2);
            CHECK(counters.candidates <= counters.triangles);
            CHECK(counters.triangles <= counters.leaves * format::max_leaf_triangles);
            CHECK(counters.triangles <= counters.groups * 8);
            const format::Profile profile = blob.opened.blob.profile();
            const unsigned most_slots = profile == format::Profile::fast ? format::plain_leaf::max_triangles
                                        : profile == format::Profile::balanced
                                            ? format::strip_leaf::max_balanced_entries - 2
                                            : format::strip_leaf::max_small_entries - 2;
            CHECK(counters.groups <= counters.leaves * ((most_slots + 7) / 8));
            CHECK(counters.groups >= counters.leaves);
            // A traversal that culls nothing would pass every other test.
            CHECK(counters.triangles < count * blob.decoded.triangle_count / 3);
            // Without culling each node would be tested once for every two of its children.
            CHECK(counters.nodes < count * blob.decoded.nodes.size());
        }
    }

    TEST_CASE("walk: a plain function serves as a filter and as a visitor") {
        const OpenedBlob cube(make_cube(-1.0f, 1.0f));
        const Ray ray{{0.25f, 0.5f, 5.0f}, {0.0f, 0.0f, -1.0f}};
        RayHit by_function;
        RayHit by_lambda;
        const bool found = raycast(cube.blob, ray, by_function, is_even);
        REQUIRE(raycast(cube.blob, ray, by_lambda, [](Triangle t) { return t.index % 2 == 0; }) == found);
        if (found) CHECK(same_bits(by_function, by_lambda));
        CHECK_FALSE(for_each_overlap(cube.blob, Sphere{{0.0f, 0.0f, 0.0f}, 9.0f}, stop_at_once));
    }
}
