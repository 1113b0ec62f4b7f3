// Claims about every builder: a sound tree within the height on any mesh, the same at any number of threads, and one
// that changes no answer.
#include "support/testing.hpp"

#include <baker/build/build.hpp>

#include "baker/baking_support.hpp"
#include "support/answers/differences.hpp"
#include "tree_support.hpp"

namespace espalier::tests::builders_test {
namespace {

struct NamedBuilder {
    const char* name;
    Builder builder;
};
constexpr std::array builders = {
    NamedBuilder{"binned_sah", Builder::binned_sah},       NamedBuilder{"sweep_sah", Builder::sweep_sah},
    NamedBuilder{"agglomerative", Builder::agglomerative}, NamedBuilder{"linear", Builder::linear},
    NamedBuilder{"insertion", Builder::insertion},
};

unsigned balanced_height_of(std::size_t count) { return baker::balanced_height(static_cast<std::uint32_t>(count)); }

/// The height of a tree that has every triangle once, in a leaf with the triangle's own box.
unsigned height_of_sound_tree(const baker::LatticeMesh& mesh, const baker::BinaryTree& tree) {
    require_each_once(tree.triangles, mesh.triangles.size());
    REQUIRE(tree.nodes[0].first == 0);
    REQUIRE(tree.nodes[0].count == mesh.triangles.size());
    std::size_t loose_boxes = 0;
    for (std::size_t i = 0; i < tree.node_count(); ++i) {
        const baker::BinaryNode& node = tree.nodes[i];
        if (!node.is_leaf()) continue;
        const auto& corners = mesh.triangles[tree.triangles[node.first]].corners;
        const LatticePoint &a = mesh.vertices[corners[0]], &b = mesh.vertices[corners[1]],
                           &c = mesh.vertices[corners[2]];
        const std::int32_t coordinates[3][3] = {{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto [low, high] = std::ranges::minmax(coordinates[axis]);
            if (double(node.lo[axis]) != low || double(node.hi[axis]) != high) ++loose_boxes;
        }
    }
    CHECK(loose_boxes == 0);
    return checked_height(tree, 0);
}

bool is_same(const baker::BinaryTree& a, const baker::BinaryTree& b) {
    return a.triangles == b.triangles &&
           std::memcmp(a.nodes.get(), b.nodes.get(), a.node_count() * sizeof(baker::BinaryNode)) == 0;
}

TEST_CASE("builder: no triangles give an empty tree") {
    for (const NamedBuilder& named : builders) {
        CAPTURE(named.name);
        CHECK(baker::build({}, named.builder, baker::build_settings(Effort::normal, 1)).triangles.empty());
    }
}

TEST_CASE("builder: awkward small inputs give a sound tree within the height of the format") {
    std::vector<baker::LatticeMesh> meshes;
    for (const std::uint32_t count : {1u, 2u, 3u, 4u, 5u, 19u, 20u, 21u}) {
        meshes.push_back(mixed_sizes(count, count));
        meshes.push_back(identical_triangles(count));
    }
    const std::uint32_t many = takes_every_case() ? 10'000 : 1'250;
    meshes.push_back(mixed_sizes(many, 1));
    meshes.push_back(concentric_triangles(many / 2));
    meshes.push_back(exponential_stairs(1));
    meshes.push_back(exponential_stairs(100));
    meshes.push_back(nearly_equal_boxes(many / 2));
    for (const NamedBuilder& named : builders) {
        CAPTURE(named.name);
        for (const baker::LatticeMesh& mesh : meshes) {
            CAPTURE(mesh.triangles.size());
            for (const Effort effort : every_effort) {
                const auto tree = baker::build(mesh, named.builder, baker::build_settings(effort, 1));
                CHECK(height_of_sound_tree(mesh, tree) <= baker::max_binary_height);
            }
        }
    }
}

TEST_CASE("builder: 100000 identical triangles give a sound tree within the height of the format") {
    const baker::LatticeMesh mesh = identical_triangles(100'000);
    for (const NamedBuilder& named : builders) {
        CAPTURE(named.name);
        const auto tree = baker::build(mesh, named.builder, baker::build_settings(Effort::normal, 1));
        CHECK(height_of_sound_tree(mesh, tree) <= baker::max_binary_height);
    }
}

TEST_CASE("builder: every builder falls back to balanced splits where its tree would become too high") {
    for (const baker::LatticeMesh& mesh : {nearly_equal_boxes(1'025), exponential_stairs(40), mixed_sizes(1'000, 3)}) {
        const unsigned balanced = balanced_height_of(mesh.triangles.size());
        for (const NamedBuilder& named : builders) {
            CAPTURE(named.name);
            baker::BuildSettings settings = baker::build_settings(Effort::normal, 1);
            const unsigned free_height = height_of_sound_tree(mesh, baker::build(mesh, named.builder, settings));
            REQUIRE(free_height > balanced);  // or this claim would test nothing
            for (settings.most_height = 0; settings.most_height <= free_height; ++settings.most_height) {
                const auto tree = baker::build(mesh, named.builder, settings);
                const unsigned height = height_of_sound_tree(mesh, tree);
                CHECK(height <= std::max(settings.most_height, balanced));
                if (settings.most_height == free_height) CHECK(height == free_height);
            }
        }
    }
}

TEST_CASE("builder: the tree is the same at any number of threads") {
    for (const baker::LatticeMesh& mesh :
         {mixed_sizes(takes_every_case() ? 20'000 : 9'000, 7), nearly_equal_boxes(9'000)}) {
        for (const NamedBuilder& named : builders) {
            CAPTURE(named.name);
            const auto one = baker::build(mesh, named.builder, baker::build_settings(Effort::fast, 1));
            constexpr unsigned threads[] = {2, 3, 16};
            for (const std::size_t i : sampled(std::size(threads), 3, mesh.triangles.size())) {
                const baker::BuildSettings settings = baker::build_settings(Effort::fast, threads[i]);
                CHECK(is_same(baker::build(mesh, named.builder, settings), one));
            }
        }
    }
}

TEST_CASE("builder: the bytes are the same with 1 and 2 threads and differ between builders") {
    const Mesh mesh = make_terrain(60, 1);
    std::vector<std::vector<std::byte>> blobs;
    for (const NamedBuilder& named : builders) {
        CAPTURE(named.name);
        BakeOptions options = {.build = {.builder = named.builder}};
        const auto one = must_bake_mesh(mesh, options);
        options.threads = 2;
        const auto two = must_bake_mesh(mesh, options);
        CHECK(one.bytes == two.bytes);
        require_sound(one.bytes);
        CHECK(std::find(blobs.begin(), blobs.end(), one.bytes) == blobs.end());
        blobs.push_back(one.bytes);
    }
}

TEST_CASE("builder: rays and spheres and closest points equal the loop for every builder") {
    for (const Mesh& mesh : {make_soup(400, 4), make_coplanar_stacks(300, 2), make_needle_fan(200)}) {
        for (const NamedBuilder& named : builders) {
            CAPTURE(named.name);
            const OpenedBlob opened(mesh, {.build = {.builder = named.builder}});
            const DecodedBlob decoded = decode(opened.bytes);
            const TriangleLoop loop(decoded);
            QueryMaker maker(decoded, 500);
            std::uint64_t hits = 0;
            for (std::uint64_t i = 0; i < std::max<std::uint64_t>(scaled(150), 30); ++i) {
                Ray ray = maker.any_ray();
                if (maker.random().below(4) == 0) maker.restrict(ray);
                require_none(ray_difference(opened.blob, loop, ray, hits));
            }
            CHECK(hits > 0);
            std::uint64_t found = 0;
            for (std::uint64_t i = 0; i < std::max<std::uint64_t>(scaled(40), 20); ++i) {
                require_none(sphere_difference(opened.blob, loop, maker.sphere(), found));
            }
            CHECK(found > 0);
        }
    }
}

}  // namespace
}  // namespace espalier::tests::builders_test
