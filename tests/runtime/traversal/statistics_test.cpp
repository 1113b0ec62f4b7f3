// Claims about the instrumented query and about what may be handed in as a visitor.
#include "support/testing.hpp"

#include <espalier/advanced/statistics.hpp>

#include "support/format/encoder.hpp"
#include "support/machine/exact_buffer.hpp"

namespace espalier::tests::statistics_test {
namespace {

bool is_even(TriangleId triangle) { return triangle.index % 2 == 0; }

Visit stop_at_once(TriangleId) { return Visit::stop; }

/// A chain of nodes as long as the format allows. The boxes of a node's leaves begin before that of its node child, so
/// that a ray from below takes all leaves first. The leaves are out of the way of a ray in the middle.
std::vector<std::byte> chain_behind_leaves(Profile profile) {
    PlainLeaf leaf;
    leaf.vertices = {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    if (profile == Profile::fast) leaf.triangles = {{0, 1, 2}};
    else leaf.entries = {{0, true, true}, {1, false, false}, {2, false, false}};
    PlainBlob blob;
    blob.decoded.profile = profile;
    blob.decoded.bits = 4;
    blob.decoded.extent = {15, 15, 15};
    blob.decoded.vertex_count = 3;
    for (std::size_t depth = 1; depth <= format::max_depth; ++depth) {
        PlainNode node;
        if (depth < format::max_depth) node.children.push_back({{15, 0, 0}, {15, 15, 15}, depth, std::nullopt});
        while (node.children.size() < format::max_node_children(profile))
            node.children.push_back({{0, 0, 0}, {15, 15, 15}, 0, leaf});
        blob.nodes.push_back(node);
    }
    return encode(blob);
}

TEST_CASE("work: the counted query gives the same bits and takes far less than the loop") {
    for (const TestBlob& blob : medium_test_blobs()) {
        CAPTURE(blob.name);
        QueryMaker maker(blob.decoded, 1'000);
        QueryCounters counters;
        const std::uint64_t count = scaled_share(300);
        for (std::uint64_t i = 0; i < count; ++i) {
            const Ray ray = maker.ray(RayKind::incoherent);
            REQUIRE(same_bits(raycast(blob.opened.blob, ray), raycast(blob.opened.blob, ray, counters)));
        }
        CHECK(counters.nodes >= count / 2);
        CHECK(counters.candidates <= counters.triangles);
        CHECK(counters.triangles <= counters.leaves * format::max_leaf_triangles);
        CHECK(counters.triangles <= counters.groups * 8);
        const Profile profile = blob.opened.blob.profile();
        const unsigned most_slots = profile == Profile::fast       ? format::plain_leaf::max_triangles
                                    : profile == Profile::balanced ? format::strip_leaf::max_balanced_entries - 2
                                    : profile == Profile::small    ? format::strip_leaf::max_small_entries - 2
                                                                   : format::predicted_strip::max_entries - 2;
        CHECK(counters.groups <= counters.leaves * ((most_slots + 7) / 8));
        CHECK(counters.groups >= counters.leaves);
        // A traversal that culls nothing would pass every other test.
        CHECK(counters.triangles < count * blob.decoded.triangle_count / 3);
        // Without culling each node would be tested once for every two of its children.
        CHECK(counters.nodes < count * blob.decoded.nodes.size());
    }
}

TEST_CASE("work: a ray tests a node once for every two of its children at most") {
    for (const Profile profile : every_profile) {
        CAPTURE(static_cast<int>(profile));
        const ExactBuffer buffer(chain_behind_leaves(profile), 0);
        const Blob blob = open(buffer.bytes());
        REQUIRE(blob);
        QueryCounters counters;
        REQUIRE_FALSE(raycast(blob, {{-20.0f, 8.0f, 8.0f}, {1.0f, 0.0f, 0.0f}}, counters));
        // The last node has leaves alone, which are taken as they lie.
        CHECK(counters.nodes == format::max_node_children(profile) / 2 * (format::max_depth - 1) + 1);
    }
}

TEST_CASE("walk: a plain function serves as a filter and as a visitor") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    const Ray ray{{0.25f, 0.5f, 5.0f}, {0.0f, 0.0f, -1.0f}};
    const RayHit by_function = raycast(cube.blob, ray, is_even);
    CHECK(same_bits(by_function, raycast(cube.blob, ray, [](TriangleId t) { return t.index % 2 == 0; })));
    CHECK(for_each_overlap(cube.blob, Sphere{{0.0f, 0.0f, 0.0f}, 9.0f}, stop_at_once) == QueryStatus::stopped);
}

}  // namespace
}  // namespace espalier::tests::statistics_test
