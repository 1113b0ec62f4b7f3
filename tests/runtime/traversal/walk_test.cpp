// Claims about walking over a blob: nothing is left out, nothing comes twice, and boxes hold what is below them.
#include "support/testing.hpp"

#include "oracle/rational.hpp"

namespace espalier::tests::walk_test {
namespace {

using espalier::oracle::Rational;

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

TEST_CASE("walk: every node comes once and after its parent with its depth and children") {
    for (const TestBlob* blob : all_test_blobs()) {
        CAPTURE(blob->name);
        const auto& nodes = blob->decoded.nodes;
        std::vector<unsigned> seen(nodes.size(), 0);
        const QueryStatus status = for_each_node(blob->opened.blob, [&](const TreeNode& node) {
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
        CHECK(status == QueryStatus::ok);
        for (const unsigned times : seen) REQUIRE(times == 1);
    }
}

TEST_CASE("walk: leaves hold the corners of their triangles and together all triangles") {
    for (const TestBlob* blob : all_test_blobs()) {
        CAPTURE(blob->name);
        std::vector<unsigned> seen(blob->opened.blob.triangle_count(), 0);
        (void)for_each_node(blob->opened.blob, [&](const TreeNode& node) {
            for (unsigned i = 0; i < node.child_count; ++i) {
                const TreeChild& child = node.children[i];
                for (std::uint32_t k = 0; child.is_leaf && k < child.count; ++k) {
                    const Result<Triangle> corners = triangle_at(blob->opened.blob, {child.first.index + k});
                    REQUIRE(corners);
                    REQUIRE(holds(child.box, corners->a));
                    REQUIRE(holds(child.box, corners->b));
                    REQUIRE(holds(child.box, corners->c));
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
        const QueryStatus status = for_each_node(blob->opened.blob, [&](const TreeNode& node) {
            REQUIRE(expected[node.number]);
            REQUIRE(node.depth == nodes[node.number].depth);
            ++visited;
            return is_skipped(node.number) ? NodeVisit::skip : NodeVisit::descend;
        });
        CHECK(status == QueryStatus::ok);
        CHECK(visited == count);
        for (const std::size_t until : {std::size_t{1}, (nodes.size() + 1) / 2}) {
            visited = 0;
            CHECK(for_each_node(blob->opened.blob, [&](const TreeNode&) {
                      return ++visited == until ? NodeVisit::stop : NodeVisit::descend;
                  }) == QueryStatus::stopped);
            CHECK(visited == until);
        }
    }
    const auto stop = [](const TreeNode&) { return NodeVisit::stop; };
    CHECK(for_each_node(Blob(), stop) == QueryStatus::not_open);
    CHECK(for_each_node(OpenedBlob(Mesh{}).blob, stop) == QueryStatus::ok);
}

TEST_CASE("walk: the corners of one triangle equal those of the walk also for duplicate references") {
    const OpenedBlob split(make_soup(500, 4), with_copies());
    REQUIRE(split.blob.duplicate_reference_count() > 0);
    std::vector<const Blob*> blobs = {&split.blob};
    for (const TestBlob* blob : all_test_blobs()) blobs.push_back(&blob->opened.blob);
    for (const Blob* blob : blobs) {
        std::uint32_t visited = 0;
        const QueryStatus status = for_each_triangle(*blob, [&](TriangleId triangle, const Triangle& expected) {
            const Result<Triangle> corners = triangle_at(*blob, triangle);
            REQUIRE(corners);
            REQUIRE(same_bits(corners->a, expected.a));
            REQUIRE(same_bits(corners->b, expected.b));
            REQUIRE(same_bits(corners->c, expected.c));
            ++visited;
        });
        REQUIRE(status == QueryStatus::ok);
        REQUIRE(visited == blob->triangle_count() - blob->duplicate_reference_count());
    }
    const DecodedBlob decoded = decode(split.bytes);
    for (std::uint32_t i = 0; i < decoded.owners.size(); ++i) {
        const Result<Triangle> corners = triangle_at(split.blob, {i});
        const Result<Triangle> owner = triangle_at(split.blob, {decoded.owners[i]});
        REQUIRE((corners && owner));
        REQUIRE(same_bits(corners->c, owner->c));
    }
    CHECK(triangle_at(split.blob, {split.blob.triangle_count()}).status == QueryStatus::invalid_argument);
    CHECK(triangle_at(split.blob, no_triangle).status == QueryStatus::invalid_argument);
    CHECK(triangle_at(Blob(), {0}).status == QueryStatus::not_open);
    CHECK(for_each_triangle(Blob(), [](TriangleId) { return Visit::stop; }) == QueryStatus::not_open);
    CHECK(for_each_triangle(split.blob, [](TriangleId) { return Visit::stop; }) == QueryStatus::stopped);
}

TEST_CASE("walk: the data of triangles are what each call returns of them") {
    Mesh mesh = make_terrain(8, 3);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) mesh.materials.push_back(static_cast<std::uint32_t>(7 * i));
    const OpenedBlob everything(mesh, {.flat_angle = 5.0f}), split(make_soup(200, 4), with_copies());
    for (const Blob* blob : {&everything.blob, &split.blob}) {
        std::vector<TriangleId> ids;
        for (std::uint32_t i = 0; i < blob->triangle_count() + 2; ++i) ids.push_back({i});
        std::vector<Result<TriangleData>> data(ids.size());
        const Filled filled = triangle_data(*blob, {ids.data()}, data);
        REQUIRE(filled.status == QueryStatus::ok);
        REQUIRE(filled.count == ids.size());
        for (std::size_t i = 0; i < ids.size(); ++i) {
            const Result<Triangle> corners = triangle_at(*blob, ids[i]);
            REQUIRE(data[i].status == corners.status);
            if (!corners) continue;
            const Vec3 expected[3] = {corners->a, corners->b, corners->c};
            const Vec3 found[3] = {data[i]->corners.a, data[i]->corners.b, data[i]->corners.c};
            for (unsigned k = 0; k < 3; ++k) {
                REQUIRE(same_bits(found[k], expected[k]));
                REQUIRE(same_bits(to_local(blob->lattice(), data[i]->in_steps[k]), expected[k]));
            }
            REQUIRE(data[i]->material == material(*blob, ids[i]));
            const EdgeKinds edges = edge_kinds(*blob, ids[i]).value;  // without edge flags: boundaries
            REQUIRE((data[i]->edges.ab == edges.ab && data[i]->edges.bc == edges.bc && data[i]->edges.ca == edges.ca));
        }
    }
    Result<TriangleData> one;
    const TriangleId first = {0};
    CHECK(triangle_data(Blob(), {&first}, {&one, 1}).status == QueryStatus::not_open);
}

}  // namespace
}  // namespace espalier::tests::walk_test
