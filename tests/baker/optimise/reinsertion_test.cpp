// Claims about moving subtrees.
#include "support/testing.hpp"

#include <baker/build/sah.hpp>
#include <baker/optimise/reinsertion.hpp>

#include "baker/build/tree_support.hpp"

namespace espalier::tests::reinsertion_test {
namespace {

double sum_of_areas(const baker::BinaryTree& tree) {
    double sum = 0.0;
    for (std::size_t i = 0; i < tree.node_count(); ++i) sum += tree.nodes[i].half_area();
    return sum;
}

TEST_CASE("builder: moved subtrees give a sound tree of the same triangles with less area") {
    for (const std::uint32_t count : {1u, 2u, 3u, 4u, 7u, 50u, 3000u}) {
        const baker::LatticeMesh mesh = mixed_sizes(count, count);
        const baker::BinaryTree before = baker::build_sah(mesh, baker::build_settings(Effort::fast, 1));
        for (const Effort effort : every_effort) {
            const baker::BinaryTree after = baker::optimise(
                baker::build_sah(mesh, baker::build_settings(Effort::fast, 1)), baker::optimise_settings(effort));
            require_each_once(after.triangles, count);
            CHECK(checked_height(after, 0) <= baker::max_binary_height);
            CHECK(sum_of_areas(after) <= sum_of_areas(before));
            if (count == 3000 && effort != Effort::fast) CHECK(sum_of_areas(after) < sum_of_areas(before));
        }
    }
}

TEST_CASE("builder: a tree that would become too high is lowered and never worse than before") {
    const baker::LatticeMesh mesh = mixed_sizes(3000, 5);
    const baker::BuildSettings build = baker::build_settings(Effort::fast, 1);
    const baker::BinaryTree before = baker::build_sah(mesh, build);
    const unsigned height_before = checked_height(before, 0);
    unsigned became_higher = 0;
    for (const std::uint32_t least_triangles : {8u, 4u, 2u}) {  // of subtrees that stay together
        baker::OptimiseSettings settings;
        settings.passes = least_triangles == 8 ? 1 : 3;
        settings.least_triangles = least_triangles;
        const auto optimised = [&] { return baker::optimise(baker::build_sah(mesh, build), settings); };
        const unsigned free_height = checked_height(optimised(), 0);
        const auto free_triangles = optimised().triangles;
        settings.most_height = free_height;
        CHECK(checked_height(optimised(), 0) == free_height);
        CHECK(optimised().triangles == free_triangles);
        settings.most_height = free_height - 1;
        CHECK(checked_height(optimised(), 0) <= free_height - 1);
        if (height_before < free_height) {
            CHECK(sum_of_areas(optimised()) <= sum_of_areas(before));
            ++became_higher;
        }
        settings.most_height = 12;  // as high as a balanced tree
        CHECK(checked_height(optimised(), 0) == 12);
        require_each_once(optimised().triangles, 3000);
    }
    CHECK(became_higher > 0);
}

TEST_CASE("builder: optimising an empty tree leaves it empty") {
    CHECK(baker::optimise({}, baker::optimise_settings(Effort::best)).triangles.empty());
}

}  // namespace
}  // namespace espalier::tests::reinsertion_test
