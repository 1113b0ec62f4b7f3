// Claims about the tree: the same at any number of threads, within the format's limits on any input, and sound.
#include "support/testing.hpp"

#include <baker/bake_with.hpp>
#include <baker/build/sah.hpp>
#include <baker/collapse/collapse.hpp>
#include <baker/optimise/reinsertion.hpp>

#include "baker/baking_support.hpp"
#include "tree_support.hpp"

namespace espalier::tests::build_tree_test {
namespace {

/// Leaves of few triangles are cheap, and a node hardly costs anything.
constexpr baker::RayCosts dear_leaves = {0.001f, 1.0f, 8.0f};

unsigned height_of(const baker::BinaryTree& tree, std::size_t node = 0) {
    if (tree.nodes[node].is_leaf()) return 0;
    return 1 + std::max(height_of(tree, baker::BinaryTree::left_of(node)), height_of(tree, tree.right_of(node)));
}

/// Triangle i is twice as large and twice as far as triangle i - 1.
Mesh exponentially_spaced(unsigned count) {
    Mesh mesh;
    for (unsigned i = 0; i < count; ++i) {
        const float size = std::ldexp(1.0f, static_cast<int>(i));
        append_triangle(mesh, {size, 0, 0}, {2 * size, 0, 0}, {size, size, 0});
    }
    return mesh;
}

/// Nodes on the longest way down when at most `levels` are allowed.
unsigned wide_depth(const baker::CollapsePlan& plan, std::uint32_t binary_node, unsigned levels) {
    REQUIRE(levels > 0);
    unsigned below = 0;
    baker::Children children = plan.children_of(binary_node, levels);
    REQUIRE(children.count >= 1);
    for (const baker::Child& child : children.list()) {
        if (!child.is_leaf) below = std::max(below, wide_depth(plan, child.binary_node, levels - 1));
    }
    return below + 1;
}

void check_soundness(const Mesh& mesh, Profile profile, const BakeOptions& options) {
    CAPTURE(mesh.name);
    CAPTURE(mesh.triangles.size());
    const auto result = must_bake_mesh(mesh, with_profile(profile, options));
    require_sound(result.bytes);
    const Blob blob = open(result.bytes);
    CHECK(blob.status() == OpenStatus::ok);
    CHECK(blob.triangle_count() == result.report.tree.triangles);
    CHECK(blob.vertex_count() == result.report.tree.vertices);
    CHECK(blob.depth() == result.report.tree.depth);
    CHECK(blob.is_closed() == result.report.closed);
    CHECK(blob.size() == result.report.bytes);
    CHECK(blob.depth() <= format::max_depth);
}

void check_soundness(const Mesh& mesh, const BakeOptions& options = {}) {
    for_each_profile([&](Profile profile) { check_soundness(mesh, profile, options); });
}

TEST_CASE("builder: the bytes of a blob are the same at any number of threads") {
    for (const Mesh& mesh : {make_terrain(60, 1), make_soup(6000, 2), make_torus(120, 50, 3.0, 1.0)}) {
        for (const Effort effort : every_effort) {
            // Effort 0 with plain leaves, 5 and 9 with strips.
            BakeOptions options = with_profile(every_profile[static_cast<std::size_t>(effort)]);
            options.effort = effort;
            const auto one = must_bake_mesh(mesh, options);
            constexpr unsigned threads[] = {0, 2, 3, 7, 64};
            for (const std::size_t number : sampled(std::size(threads), 5, one.bytes.size())) {
                options.threads = threads[number];
                const auto many = must_bake_mesh(mesh, options);
                CHECK(many.bytes == one.bytes);
            }
        }
    }
}

TEST_CASE("builder: every size from 0 to 100 triangles gives a sound blob") {
    for (std::size_t count = 0; count <= 100; ++count) {
        check_soundness(first_triangles(make_soup(100, 3), count));
        check_soundness(first_triangles(make_terrain(8, 3), count));
    }
}

TEST_CASE("builder: one triangle gives a root with one leaf") {
    const auto result = must_bake_mesh(first_triangles(make_cube(0.0f, 1.0f), 1));
    CHECK(result.report.tree.nodes == 1);
    CHECK(result.report.tree.leaves == 1);
    CHECK(result.report.tree.depth == 1);
}

TEST_CASE("builder: every kind of mesh gives a sound blob on every lattice and at every effort") {
    for (const Mesh& mesh :
         {make_cube(-1.0f, 1.0f), make_icosphere(3, 1.0, {0, 0, 0}), make_uv_sphere(40, 60, 2.0, {1, 1, 1}),
          make_torus(40, 30, 3.0, 1.0), make_far_sphere(), make_plane_grid(30), make_terrain(30, 1),
          make_needle_fan(500), make_slivers(500, 1), make_coplanar_stacks(500, 1), make_soup(1000, 1)}) {
        constexpr unsigned bits[] = {1, 2, 7, 8, 15, 16, 17, 20, 24};
        for (const std::size_t number : sampled(std::size(bits), 9, mesh.triangles.size()))
            check_soundness(mesh, with_bits(bits[number]));
        for (const Effort effort : every_effort) {
            check_soundness(mesh, {.effort = effort});
        }
    }
}

TEST_CASE("builder: flat meshes and rows of triangles are sound along every axis") {
    for (int axis = 0; axis < 3; ++axis) {
        Mesh grid = make_plane_grid(20);
        Mesh row = exponentially_spaced(15);
        for (int turn = 0; turn < axis; ++turn) {
            for (Vec3& point : grid.positions) point = {point.z, point.x, point.y};
            for (Vec3& point : row.positions) point = {point.z, point.x, point.y};
        }
        check_soundness(grid);
        check_soundness(row, with_bits(24));
    }
}

TEST_CASE("builder: exponentially spaced triangles stay within the depth") {
    check_soundness(exponentially_spaced(22), with_bits(24));
}

TEST_CASE("builder: the heuristic falls back to balance exactly where the tree would become too high") {
    for (const baker::LatticeMesh& mesh :
         {nearly_equal_boxes(1000), nearly_equal_boxes(1024), nearly_equal_boxes(1025)}) {
        baker::BuildSettings settings = baker::build_settings(Effort::normal, 1);
        const unsigned free_height = height_of(baker::build_sah(mesh, settings));
        const unsigned balanced_height = mesh.triangles.size() <= 1024 ? 10 : 11;
        REQUIRE(free_height > balanced_height + 3);  // or this claim would test nothing
        for (settings.most_height = 0; settings.most_height <= free_height; ++settings.most_height) {
            const unsigned height = height_of(baker::build_sah(mesh, settings));
            CHECK(height <= std::max(settings.most_height, balanced_height));
            if (settings.most_height == free_height) CHECK(height == free_height);
        }
    }
}

TEST_CASE("builder: a few leaves are split so that no leaf is added where boxes cost nearly the same") {
    constexpr std::uint32_t count = 96;  // in a row
    baker::LatticeMesh mesh;
    mesh.lattice.bits = 16;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(count); ++i) {
        add_triangle(mesh, {100 * i, 0, 0}, {100 * i + 90, 0, 90}, {100 * i, 90, 0});
    }
    baker::BuildSettings settings = baker::build_settings(Effort::normal, 1);
    const auto left_count = [&] { return baker::build_sah(mesh, settings).nodes[1].count; };
    CHECK(left_count() == count / 2);  // the smallest boxes
    settings.full_leaf = 40;
    CHECK(std::min(left_count(), count - left_count()) <= 40);  // one leaf and two, not two and two
    settings.full_leaf = 15;                                    // more than six leaves: split anywhere
    CHECK(left_count() == count / 2);
}

TEST_CASE("builder: three levels of a binary tree always collapse into one wide level") {
    const baker::LatticeMesh mesh = nearly_equal_boxes(5000);
    const baker::BinaryTree tree = baker::build_sah(mesh, baker::build_settings(Effort::normal, 1));
    const unsigned least_levels = (height_of(tree) + 2) / 3;
    const auto sizes = baker::leaf_sizes(Profile::fast, 16, nullptr);
    for (const baker::CollapseSettings& settings :
         {baker::CollapseSettings{}, baker::CollapseSettings{Profile::fast, dear_leaves, 0.0f}}) {
        const baker::CollapsePlan plan(mesh, tree, *sizes, settings);
        for (unsigned levels = least_levels; levels <= format::max_depth; ++levels) {
            CHECK(wide_depth(plan, 0, levels) <= levels);
        }
    }
}

TEST_CASE("builder: a collapse that prefers long chains keeps the depth") {
    // Free bytes and dear leaves: the dynamic program takes whatever nodes it likes.
    const Mesh mesh = as_mesh(nearly_equal_boxes(30'000));
    using Prices = std::pair<baker::RayCosts, float>;
    for (const auto& [costs, byte_price] :
         {Prices{dear_leaves, 0.0f}, Prices{{1.0f, 0.0f, 0.0f}, 0.0f}, Prices{{1.0f, 0.0f, 1.0f}, 1000.0f}}) {
        BakeOptions options = with_bits(24);
        options.build.byte_price = byte_price;
        const auto make_tree = [](const baker::LatticeMesh& lattice_mesh, const baker::BuildSettings& settings) {
            return baker::optimise(baker::build_sah(lattice_mesh, settings), baker::optimise_settings(Effort::normal));
        };
        const MeshView view = mesh.view();
        const auto result = baker::bake_with(make_tree, {&view, 1}, options, costs);
        REQUIRE(result);
        CHECK(result.report.tree.depth <= format::max_depth);
        CHECK(verify(result.bytes));
    }
}

TEST_CASE("builder: leaves reach the size in the options and never exceed it") {
    const Mesh mesh = make_terrain(60, 3);
    for (const Profile profile : {Profile::fast, Profile::balanced, Profile::small}) {
        for (unsigned most = 1; most <= format::plain_leaf::max_triangles; ++most) {
            CAPTURE(name_of(profile));
            CAPTURE(most);
            BakeOptions options = {.profile = profile, .build = {.max_leaf_triangles = most}};
            options.build.byte_price = 20.0f;  // large leaves are wanted
            const auto result = must_bake_mesh(mesh, options);
            CHECK(verify(result.bytes));
            const DecodedBlob decoded = decode(result.bytes);
            CHECK(decoded.triangles.size() == mesh.triangles.size());
            CHECK(*std::max_element(decoded.triangles_in_leaf.begin(), decoded.triangles_in_leaf.end()) == most);
        }
    }
}

TEST_CASE("builder: nodes have as many children as their profile allows and never more") {
    const Mesh mesh = make_terrain(60, 3);
    for_each_profile([&](Profile profile) {
        std::size_t most = 0;
        for (const DecodedNode& node : decode(bake_or_throw(mesh, with_profile(profile))).nodes)
            most = std::max(most, node.children.size());
        CHECK(most == (profile == Profile::fast ? 16 : 8));
    });
}

TEST_CASE("builder: a senseless leaf size or price is refused by name") {
    const Mesh mesh = make_terrain(4, 3);
    for (const unsigned most : {0u, format::max_leaf_triangles + 1u})
        check_refused(bake_mesh(mesh, {.build = {.max_leaf_triangles = most}}), BakeStatus::invalid_options,
                      {"max_leaf_triangles"});
    for (const float price : {-1.0f, not_a_number, std::numeric_limits<float>::infinity(), 1e7f})
        check_refused(bake_mesh(mesh, {.build = {.byte_price = price}}), BakeStatus::invalid_options, {"byte_price"});
}

TEST_CASE("builder: a higher cost for bytes gives a smaller blob") {
    const Mesh mesh = make_terrain(60, 3);
    std::uint64_t last = std::numeric_limits<std::uint64_t>::max();
    for (const float price : {0.0f, 5.0f, 100.0f}) {
        const auto result = must_bake_mesh(mesh, {.build = {.byte_price = price}});
        CHECK(result.report.bytes < last);
        last = result.report.bytes;
    }
}

TEST_CASE("builder: every triangle is stored exactly once") {
    const Mesh mesh = make_soup(3000, 17);
    const auto result = must_bake_mesh(mesh, {.original_ids = true});
    const DecodedBlob decoded = decode(result.bytes);
    const std::set<std::uint32_t> ids(decoded.original_ids.begin(), decoded.original_ids.end());
    CHECK(ids.size() == result.report.tree.triangles);
    CHECK(decoded.triangles.size() == result.report.tree.triangles);
    CHECK(result.report.tree.triangles + result.report.findings.collapsed.count +
              result.report.findings.duplicate.count + result.report.findings.zero_area.count ==
          mesh.triangles.size());
}

TEST_CASE("builder: plain leaves ascend by source triangle and larger siblings come first") {
    const Mesh mesh = make_terrain(40, 6);
    const auto result = must_bake_mesh(mesh, {.profile = Profile::fast, .original_ids = true});
    const DecodedBlob decoded = decode(result.bytes);
    std::size_t first = 0;
    for (const std::uint8_t count : decoded.triangles_in_leaf) {
        CHECK(std::is_sorted(decoded.original_ids.begin() + static_cast<std::ptrdiff_t>(first),
                             decoded.original_ids.begin() + static_cast<std::ptrdiff_t>(first + count)));
        first += count;
    }
    CHECK(first == decoded.triangles.size());
}

TEST_CASE("builder: more effort keeps the set of triangles") {
    const Mesh mesh = make_terrain(60, 2);
    std::set<std::uint32_t> counts;
    for (const Effort effort : every_effort) {
        const auto result = must_bake_mesh(mesh, {.effort = effort});
        counts.insert(result.report.tree.triangles);
    }
    CHECK(counts.size() == 1);
}

}  // namespace
}  // namespace espalier::tests::build_tree_test
