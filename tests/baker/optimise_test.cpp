// Claims about moving subtrees.
#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

#include <baker/build_sah.hpp>
#include <baker/optimise.hpp>

#include "../support/random.hpp"
#include "baking_support.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

/// Triangles of many sizes in a cube, which no heuristic that only splits gets right.
baker::LatticeMesh mixed_sizes(std::uint32_t count, std::uint64_t seed) {
    baker::LatticeMesh mesh;
    mesh.lattice.bits = 16;
    Random random(seed);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::int32_t size = 10 << random.below(10);
        const auto from = [&] { return random.between(0, 65'535 - size); };
        const baker::LatticePoint a = {from(), from(), from()};
        const auto near = [&](std::int32_t coordinate) { return coordinate + random.between(0, size); };
        mesh.vertices.push_back(a);
        mesh.vertices.push_back({near(a.x), near(a.y), near(a.z)});
        mesh.vertices.push_back({near(a.x), near(a.y), near(a.z)});
        mesh.triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, i});
    }
    return mesh;
}

double sum_of_areas(const baker::BinaryTree& tree) {
    double sum = 0.0;
    for (std::size_t i = 0; i < tree.node_count(); ++i) sum += tree.nodes[i].half_area();
    return sum;
}

/// Height of the subtree, having checked that it lies together and that its box is the one around its children.
unsigned checked_height(const baker::BinaryTree& tree, std::size_t node) {
    const baker::BinaryNode& here = tree.nodes[node];
    if (here.is_leaf()) return 0;
    const baker::BinaryNode& left = tree.nodes[baker::BinaryTree::left_of(node)];
    const baker::BinaryNode& right = tree.nodes[tree.right_of(node)];
    CHECK(left.count + right.count == here.count);
    CHECK(left.first == here.first);
    CHECK(right.first == here.first + left.count);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        CHECK(here.lo[axis] == std::min(left.lo[axis], right.lo[axis]));
        CHECK(here.hi[axis] == std::max(left.hi[axis], right.hi[axis]));
    }
    return 1 +
           std::max(checked_height(tree, baker::BinaryTree::left_of(node)), checked_height(tree, tree.right_of(node)));
}

}  // namespace

TEST_SUITE("baker") {
    TEST_CASE("moved subtrees make a sound tree of the same triangles with less area") {
        for (const std::uint32_t count : {1u, 2u, 3u, 4u, 7u, 50u, 3000u}) {
            const baker::LatticeMesh mesh = mixed_sizes(count, count);
            const baker::BinaryTree before = baker::build_sah(mesh, baker::build_settings(0, 1));
            for (unsigned effort = 0; effort <= 9; ++effort) {
                const baker::BinaryTree after = baker::optimise(baker::build_sah(mesh, baker::build_settings(0, 1)),
                                                                baker::optimise_settings(effort));
                REQUIRE(after.triangles.size() == count);
                CHECK(checked_height(after, 0) <= baker::max_binary_height);
                auto triangles = after.triangles;
                std::sort(triangles.begin(), triangles.end());
                std::vector<std::uint32_t> all(count);
                std::iota(all.begin(), all.end(), 0u);
                CHECK(triangles == all);
                CHECK(sum_of_areas(after) <= sum_of_areas(before));
                if (count == 3000 && effort >= 4) CHECK(sum_of_areas(after) < sum_of_areas(before));
            }
        }
    }

    TEST_CASE("a tree that would become too high stays as it was") {
        const baker::LatticeMesh mesh = mixed_sizes(3000, 5);
        const baker::BuildSettings build = baker::build_settings(0, 1);
        const baker::BinaryTree before = baker::build_sah(mesh, build);
        for (const unsigned effort : {5u, 8u, 9u}) {  // large, small and no subtrees that stay together
            baker::OptimiseSettings settings = baker::optimise_settings(effort);
            const auto optimised = [&] { return baker::optimise(baker::build_sah(mesh, build), settings); };
            const unsigned free_height = checked_height(optimised(), 0);
            settings.most_height = free_height;
            CHECK(checked_height(optimised(), 0) == free_height);
            CHECK(optimised().triangles != before.triangles);
            settings.most_height = free_height - 1;
            CHECK(optimised().triangles == before.triangles);
        }
    }

    TEST_CASE("an empty tree stays empty") {
        CHECK(baker::optimise({}, baker::optimise_settings(9)).triangles.empty());
    }
}
