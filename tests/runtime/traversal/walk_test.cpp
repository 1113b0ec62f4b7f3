// Claims about walking over a blob: nothing is left out, nothing comes twice, and boxes hold what is below them.
#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

#include <espalier/espalier.hpp>

#include "oracle/rational.hpp"
#include "support/base/profiles.hpp"
#include "support/base/same_bits.hpp"
#include "support/blobs/baking.hpp"
#include "support/blobs/test_blobs.hpp"
#include "support/meshes/makers.hpp"

using namespace espalier;
using namespace espalier::tests;
using espalier::oracle::Rational;

namespace {

Rational in_world(const DecodedBlob& blob, std::size_t axis, std::int32_t steps) {
    return Rational::of(blob.origin[axis]) + Rational::of(std::int64_t{steps}, blob.step_exponent);
}

/// Outward, and by two steps of float at most.
void check_box(const DecodedBlob& blob, const GridBox& grid, const Box& box) {
    const float low[3] = {box.min.x, box.min.y, box.min.z};
    const float high[3] = {box.max.x, box.max.y, box.max.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        REQUIRE(Rational::of(low[axis]) <= in_world(blob, axis, grid.low[axis]));
        REQUIRE(Rational::of(high[axis]) >= in_world(blob, axis, grid.high[axis]));
    }
}

bool holds(const Box& box, Vec3 p) {
    return box.min.x <= p.x && p.x <= box.max.x && box.min.y <= p.y && p.y <= box.max.y && box.min.z <= p.z &&
           p.z <= box.max.z;
}

std::vector<const TestBlob*> all_test_blobs() {
    std::vector<const TestBlob*> all;
    for (const TestBlob& blob : small_test_blobs()) all.push_back(&blob);
    for (const TestBlob& blob : medium_test_blobs()) all.push_back(&blob);
    return all;
}

}  // namespace

TEST_SUITE("walk") {
    TEST_CASE("walk: every node comes once and after its parent with its depth and children") {
        for (const TestBlob* blob : all_test_blobs()) {
            CAPTURE(blob->name);
            const auto& nodes = blob->decoded.nodes;
            std::vector<unsigned> seen(nodes.size(), 0);
            const bool saw_all = for_each_node(blob->opened.blob, [&](const TreeNode& node) {
                REQUIRE(node.number < nodes.size());
                const DecodedNode& expected = nodes[node.number];
                ++seen[node.number];
                REQUIRE(node.depth == expected.depth);
                REQUIRE(node.child_count == expected.children.size());
                for (unsigned i = 0; i < node.child_count; ++i) {
                    const TreeChild& child = node.children[i];
                    const DecodedChild& meant = expected.children[i];
                    REQUIRE(child.is_leaf == !meant.is_node);
                    check_box(blob->decoded, meant.box, child.box);
                    if (child.is_leaf) {
                        REQUIRE(child.first.index == meant.first_triangle);
                        REQUIRE(child.count == meant.triangle_count);
                    } else {
                        REQUIRE(child.node == meant.node);
                        REQUIRE(seen[child.node] == 0);
                    }
                }
                return NodeVisit::descend;
            });
            CHECK(saw_all);
            for (const unsigned times : seen) REQUIRE(times == 1);
        }
    }

    TEST_CASE("walk: leaves hold the corners of their triangles and together all triangles") {
        for (const TestBlob* blob : all_test_blobs()) {
            CAPTURE(blob->name);
            std::vector<unsigned> seen(blob->opened.blob.triangle_count(), 0);
            for_each_node(blob->opened.blob, [&](const TreeNode& node) {
                for (unsigned i = 0; i < node.child_count; ++i) {
                    const TreeChild& child = node.children[i];
                    for (std::uint32_t k = 0; child.is_leaf && k < child.count; ++k) {
                        Corners corners;
                        REQUIRE(triangle_corners(blob->opened.blob, {child.first.index + k}, corners));
                        REQUIRE(holds(child.box, corners.a));
                        REQUIRE(holds(child.box, corners.b));
                        REQUIRE(holds(child.box, corners.c));
                        ++seen[child.first.index + k];
                    }
                }
                return NodeVisit::descend;
            });
            for (const unsigned times : seen) REQUIRE(times == 1);
        }
    }

    TEST_CASE("walk: skipping a node leaves out its subtree only and ending ends") {
        for (const TestBlob* blob : all_test_blobs()) {
            const auto& nodes = blob->decoded.nodes;
            const auto is_skipped = [](std::uint32_t number) { return number % 3 == 1; };
            std::vector<bool> expected(nodes.size(), false);
            expected[0] = true;
            std::size_t count = 0;
            for (std::size_t i = 0; i < nodes.size(); ++i) {  // children come after their parents
                if (!expected[i]) continue;
                ++count;
                for (const DecodedChild& child : nodes[i].children)
                    if (child.is_node && !is_skipped(static_cast<std::uint32_t>(i))) expected[child.node] = true;
            }
            std::size_t visited = 0;
            const bool saw_all = for_each_node(blob->opened.blob, [&](const TreeNode& node) {
                REQUIRE(expected[node.number]);
                REQUIRE(node.depth == nodes[node.number].depth);
                ++visited;
                return is_skipped(node.number) ? NodeVisit::skip : NodeVisit::descend;
            });
            CHECK(saw_all);
            CHECK(visited == count);
            for (const std::size_t until : {std::size_t{1}, (nodes.size() + 1) / 2}) {
                visited = 0;
                CHECK(!for_each_node(blob->opened.blob, [&](const TreeNode&) {
                    return ++visited == until ? NodeVisit::end : NodeVisit::descend;
                }));
                CHECK(visited == until);
            }
        }
        CHECK(for_each_node(Blob(), [](const TreeNode&) { return NodeVisit::end; }));
    }

    TEST_CASE("walk: the corners of one triangle equal those of the walk also for copies") {
        BakeOptions options = with_profile(format::Profile::fast);
        options.builder = Builder::spatial_splits;
        options.duplicates = 1.0;
        const OpenedBlob with_copies(make_soup(500, 4), options);
        REQUIRE(with_copies.blob.copy_count() > 0);
        std::vector<const Blob*> blobs = {&with_copies.blob};
        for (const TestBlob* blob : all_test_blobs()) blobs.push_back(&blob->opened.blob);
        for (const Blob* blob : blobs) {
            for_each_triangle(*blob, [&](Triangle triangle, const Corners& expected) {
                Corners corners;
                REQUIRE(triangle_corners(*blob, triangle, corners));
                REQUIRE(same_bits(corners.a, expected.a));
                REQUIRE(same_bits(corners.b, expected.b));
                REQUIRE(same_bits(corners.c, expected.c));
                return keep_going;
            });
        }
        const DecodedBlob decoded = decode(with_copies.bytes);
        for (std::uint32_t i = 0; i < decoded.owners.size(); ++i) {
            Corners corners;
            Corners owner;
            REQUIRE(triangle_corners(with_copies.blob, {i}, corners));
            REQUIRE(triangle_corners(with_copies.blob, {decoded.owners[i]}, owner));
            REQUIRE(same_bits(corners.c, owner.c));
        }
        Corners untouched = {{1, 2, 3}, {}, {}};
        CHECK(!triangle_corners(with_copies.blob, {with_copies.blob.triangle_count()}, untouched));
        CHECK(!triangle_corners(Blob(), {0}, untouched));
        CHECK(untouched.a == Vec3{1, 2, 3});
    }
}
