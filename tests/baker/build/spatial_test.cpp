// Claims about triangles that lie in several leaves: their parts hold all of them, and no query can tell.
#include "support/testing.hpp"

#include <baker/build/build.hpp>
#include <baker/build/spatial.hpp>
#include <espalier/advanced/statistics.hpp>

#include "baker/baking_support.hpp"
#include "support/answers/differences.hpp"
#include "tree_support.hpp"

namespace espalier::tests::spatial_test {
namespace {

BakeOptions with_splits(double duplicates = 1.0, unsigned bits = 16) {
    return {.resolution = Resolution::bits(bits),
            .profile = Profile::fast,
            .build = {.builder = Builder::spatial_splits, .duplicate_budget = duplicates}};
}

/// Whether the boxes hold all points of a fine grid on the triangle, exactly: coordinates are compared as fractions.
bool hold_grid(const std::vector<baker::BinaryNode>& boxes, const std::array<LatticePoint, 3>& corners) {
    const std::int64_t steps = takes_every_case() ? 60 : 20;
    for (std::int64_t i = 0; i <= steps; ++i) {
        for (std::int64_t j = 0; i + j <= steps; ++j) {
            const auto times_steps = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
                return static_cast<double>((steps - i - j) * a + i * b + j * c);  // below 2^53
            };
            const double at[3] = {times_steps(corners[0].x, corners[1].x, corners[2].x),
                                  times_steps(corners[0].y, corners[1].y, corners[2].y),
                                  times_steps(corners[0].z, corners[1].z, corners[2].z)};
            const auto holds = [&](const baker::BinaryNode& box) {
                bool inside = true;
                for (int axis = 0; axis < 3; ++axis) {
                    inside = inside && double(box.lo[axis]) * double(steps) <= at[axis] &&
                             at[axis] <= double(box.hi[axis]) * double(steps);
                }
                return inside;
            };
            if (std::none_of(boxes.begin(), boxes.end(), holds)) return false;
        }
    }
    return true;
}

std::vector<Mesh> meshes_to_split() {
    return {crossed_by_beams(60, 600, 1), make_soup(500, 4), make_coplanar_stacks(300, 2), make_needle_fan(200),
            make_slivers(300, 3)};
}

TEST_CASE("spatial split: the parts of a triangle cover it within the budget and the height") {
    for (const baker::LatticeMesh& mesh :
         {mixed_sizes(2'000, 3), nearly_equal_boxes(500), exponential_stairs(20), identical_triangles(1'000),
          concentric_triangles(300), mixed_sizes(1, 1), mixed_sizes(2, 1)}) {
        const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
        CAPTURE(count);
        for (const double duplicates : {0.0, 0.1, 1.0}) {
            baker::BuildSettings settings = baker::build_settings(Effort::normal, 1);
            settings.duplicate_budget = duplicates;
            const baker::BinaryTree tree = baker::build_spatial(mesh, settings);
            CHECK(static_cast<double>(tree.triangles.size()) <= (1.0 + duplicates) * count);
            CHECK(checked_height(tree, 0) <= baker::max_binary_height);
            std::vector<std::vector<baker::BinaryNode>> boxes(count);
            for (std::size_t i = 0; i < tree.node_count(); ++i) {
                if (tree.nodes[i].is_leaf()) boxes[tree.triangles[tree.nodes[i].first]].push_back(tree.nodes[i]);
            }
            for (std::uint32_t t = 0; t < count; ++t) {
                const auto& corners = mesh.triangles[t].corners;
                REQUIRE(hold_grid(boxes[t],
                                  {mesh.vertices[corners[0]], mesh.vertices[corners[1]], mesh.vertices[corners[2]]}));
            }
        }
    }
}

TEST_CASE("spatial split: splits fall back to balance where the tree would become too high") {
    const baker::LatticeMesh mesh = mixed_sizes(1'000, 3);
    baker::BuildSettings settings = baker::build_settings(Effort::normal, 1);
    settings.duplicate_budget = 1.0;
    for (settings.most_height = 0; settings.most_height < 24; ++settings.most_height) {
        const baker::BinaryTree tree = baker::build_spatial(mesh, settings);
        CHECK(checked_height(tree, 0) <= std::max(settings.most_height, 10u));
    }
}

TEST_CASE("spatial split: without a budget the tree is that of binned SAH") {
    const Mesh mesh = crossed_by_beams(60, 600, 1);
    const auto split = must_bake_mesh(mesh, with_splits(0.0));
    const auto plain = must_bake_mesh(mesh, {.profile = Profile::fast});
    CHECK(split.bytes == plain.bytes);
    CHECK(split.report.tree.duplicate_references == 0);
}

TEST_CASE("spatial split: copies are counted and sound and reduce the visits at any number of threads") {
    const Mesh mesh = crossed_by_beams(60, 600, 1);
    const auto one = must_bake_mesh(mesh, with_splits());
    BakeOptions options = with_splits();
    options.threads = 3;
    const auto three = must_bake_mesh(mesh, options);
    CHECK(one.bytes == three.bytes);
    CHECK(one.report.tree.duplicate_references > 20);
    const OpenedBlob opened(one.bytes);
    CHECK(opened.blob.duplicate_reference_count() == one.report.tree.duplicate_references);
    CHECK(opened.blob.triangle_count() == one.report.tree.triangles + one.report.tree.duplicate_references);
    CHECK((detail::data_of(opened.blob).features & format::feature::split_references) != 0);
    require_sound(one.bytes);

    const OpenedBlob plain(mesh);
    QueryCounters counters;
    QueryCounters plain_counters;
    for (unsigned i = 0; i < 500; ++i) {
        const float x = static_cast<float>(i % 25) * 0.04f;
        const float y = static_cast<float>(i / 25) * 0.05f;
        const Ray down = {.origin = {x, y, 5.0f}, .direction = {0, 0, -1}};
        REQUIRE(same_bits(raycast(opened.blob, down, counters), raycast(opened.blob, down)));
        static_cast<void>(raycast(plain.blob, down, plain_counters));
    }
    CHECK(counters.triangles < plain_counters.triangles);
}

TEST_CASE("spatial split: rays and spheres and closest points equal the loop and report owners only") {
    std::uint64_t copies = 0;
    for (const Mesh& mesh : meshes_to_split()) {
        for (const unsigned bits : {9u, 15u, 16u, 20u, 24u}) {
            CAPTURE(mesh.name);
            CAPTURE(bits);
            const OpenedBlob opened(mesh, with_splits(1.0, bits));
            copies += opened.blob.duplicate_reference_count();
            require_sound(opened.bytes);
            const DecodedBlob decoded = decode(opened.bytes);
            const TriangleLoop loop(decoded);
            QueryMaker maker(decoded, 500 + bits);
            std::uint64_t hits = 0;
            for (std::uint64_t i = 0; i < scaled(200); ++i) {
                Ray ray = maker.any_ray();
                if (maker.random().below(4) == 0) maker.restrict(ray);
                require_none(ray_difference(opened.blob, loop, ray, hits));
            }
            CHECK(hits > 0);
            std::uint64_t found = 0, near = 0;
            for (std::uint64_t i = 0; i < scaled(50); ++i) {
                require_none(sphere_difference(opened.blob, loop, maker.sphere(), found));
                const Vec3 from = maker.sphere().center, to = maker.sphere().center;
                // Some shapes are too far away: those are refused.
                const ClosestPoint pair = closest_point(opened.blob, Segment{from, to});
                if (pair) CHECK(decoded.owners[pair.triangle.index] == pair.triangle.index);
                near += pair ? 1u : 0u;
                const Box box = {{std::min(from.x, to.x), std::min(from.y, to.y), std::min(from.z, to.z)},
                                 {std::max(from.x, to.x), std::max(from.y, to.y), std::max(from.z, to.z)}};
                if (const ClosestPoint to_box = closest_point(opened.blob, box))
                    CHECK(decoded.owners[to_box.triangle.index] == to_box.triangle.index);
            }
            if (asks_enough()) CHECK(found > 0);
            if (asks_enough()) CHECK(near > 0);
        }
    }
    CHECK(copies > 500);  // or this claim would test nothing
}

TEST_CASE("spatial split: filters are called with owners only") {
    const OpenedBlob opened(crossed_by_beams(60, 600, 1), with_splits());
    const DecodedBlob decoded = decode(opened.bytes);
    QueryMaker maker(decoded, 7);
    bool only_owners = true;
    std::uint64_t asked = 0;
    for (unsigned i = 0; i < 300; ++i) {
        const auto filter = [&](TriangleId triangle) {
            ++asked;
            only_owners = only_owners && decoded.owners[triangle.index] == triangle.index;
            return false;
        };
        CHECK_FALSE(raycast(opened.blob, maker.any_ray(), filter));
        CHECK_FALSE(occluded(opened.blob, maker.any_ray(), filter).yes());
    }
    CHECK(asked > 100);
    CHECK(only_owners);
}

TEST_CASE("spatial split: a walk over the triangles leaves duplicate references out") {
    const OpenedBlob opened(crossed_by_beams(60, 600, 1), with_splits());
    REQUIRE(opened.blob.duplicate_reference_count() > 0);
    std::set<std::uint32_t> walked;
    CHECK(for_each_triangle(opened.blob, [&](TriangleId triangle) { walked.insert(triangle.index); }) ==
          QueryStatus::ok);
    CHECK(walked.size() == opened.blob.triangle_count() - opened.blob.duplicate_reference_count());
}

TEST_CASE("spatial split: ids and materials of an owner are those of its source") {
    Mesh mesh = crossed_by_beams(60, 600, 1);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) mesh.materials.push_back(static_cast<std::uint32_t>(i));
    BakeOptions options = with_splits();
    options.original_ids = true;
    const OpenedBlob opened(mesh, options);
    for (std::uint32_t i = 0; i < opened.blob.triangle_count(); ++i) {
        const Result<OriginalTriangle> original = original_triangle(opened.blob, TriangleId{i});
        REQUIRE(original);
        CHECK(original->triangle == material(opened.blob, TriangleId{i}));
    }
}

TEST_CASE("spatial split: every bit of the map of copies is checked or harmless") {
    const OpenedBlob opened(crossed_by_beams(20, 100, 2), with_splits());
    REQUIRE(opened.blob.duplicate_reference_count() > 0);
    const auto map_at = static_cast<std::size_t>(detail::data_of(opened.blob).copies - opened.bytes.data());
    std::uint64_t refused = 0, opens = 0;
    for (std::size_t bit = 8 * map_at; bit < 8 * opened.bytes.size(); ++bit) {
        auto bytes = opened.bytes;
        bytes[bit / 8] ^= std::byte{1} << (bit % 8);
        repair_checksum(bytes);
        const Blob blob = open(bytes);
        if (!blob) {
            ++refused;
            continue;
        }
        ++opens;  // another owner, that is: lower, and no copy itself
        CHECK(!verify(bytes));
        static_cast<void>(raycast(blob, {.origin = {0.5f, 0.5f, 5.0f}, .direction = {0, 0, -1}}));
    }
    CHECK(refused > opens);
    for (std::size_t size = map_at; size < opened.bytes.size(); size += 4) {
        auto bytes = opened.bytes;
        bytes.resize(size);
        const Blob blob = open(bytes);
        CHECK(blob.status() != OpenStatus::ok);
    }
}

TEST_CASE("verify: parts that leave out a corner of their triangle are found") {
    const OpenedBlob opened(crossed_by_beams(60, 600, 1), with_splits());
    auto bytes = opened.bytes;
    // The highest plane of the root's first child, one lower: whatever reached up to it is now cut off.
    const std::size_t plane = format::header::bytes + format::plain_node::hi_at + format::plain_node::row_bytes;
    REQUIRE(get(bytes, plane, 2) > get(bytes, plane - 96, 2) + 1);
    put(bytes, plane, (get(bytes, plane, 2) + get(bytes, plane - 96, 2)) / 2, 2);
    repair_checksum(bytes);
    REQUIRE(open(bytes));
    CHECK(contains(verify(bytes).message, "corner"));
}

}  // namespace
}  // namespace espalier::tests::spatial_test
