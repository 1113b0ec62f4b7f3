#include "layout/tree_quality_report.hpp"

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <string>
#include <utility>

#include "base/numbers.hpp"

namespace espalier::tools {

namespace {

Json level_json(const LevelQuality& level) {
    return {{"nodes", level.nodes},
            {"leaves", level.leaves},
            {"triangles", level.triangles},
            {"node_areas", level.node_areas},
            {"leaf_areas", level.leaf_areas},
            {"volumes", level.volumes},
            {"shared_areas", level.shared_areas}};
}

void print_level(const std::string& name, const LevelQuality& level, const std::string& share) {
    std::cout << "    " << std::left << std::setw(6) << name << std::right << std::setw(10) << level.nodes
              << std::setw(10) << level.leaves << std::setw(11) << level.triangles << std::setw(10)
              << rounded(level.areas(), 3) << std::setw(7) << share << std::setw(10) << rounded(level.volumes, 3)
              << std::setw(10) << rounded(level.shared_areas, 3) << '\n';
}

/// Returns a part of a sum that adds up so far, in percent.
std::string percent(double part, double sum) { return sum > 0.0 ? rounded(100.0 * part / sum, 3) + " %" : "-"; }

void print_levels(const TreeQuality& quality) {
    std::cout << "  boxes, areas and volumes over those of the whole box\n"
              << "    depth      nodes    leaves  triangles     areas so far   volumes    shared\n";
    double areas = 0.0;
    for (std::size_t i = 0; i < quality.levels.size(); ++i) {
        areas += quality.levels[i].areas();
        print_level(text(i + 1), quality.levels[i], percent(areas, quality.all.areas()));
    }
    print_level("all", quality.all, "");
}

void print_balance(const TreeQuality& quality) {
    std::cout << "  a random line through the whole box is expected to meet\n    " << rounded(quality.all.node_areas, 4)
              << " nodes beside the root, " << rounded(quality.all.leaf_areas, 4) << " leaves with "
              << rounded(quality.triangle_areas, 4) << " triangles\n"
              << "  balance\n    leaves at depth " << quality.least_leaf_depth << " to " << quality.greatest_leaf_depth
              << ", on average " << rounded(quality.mean_leaf_depth, 3) << "; a tree of full nodes has "
              << rounded(quality.full_leaf_depth, 3) << "\n    " << rounded(quality.children_per_node, 3)
              << " children a node\n";
}

void print_leaves(const TreeQuality& quality) {
    constexpr std::size_t widest_bar = 50;
    const std::uint64_t most = *std::max_element(quality.leaves_of_size.begin(), quality.leaves_of_size.end());
    std::cout << "  triangles in a leaf, and leaves that have so many\n";
    for (std::size_t size = 0; size < quality.leaves_of_size.size(); ++size) {
        const std::uint64_t leaves = quality.leaves_of_size[size];
        if (leaves == 0) continue;
        const auto bar = static_cast<std::size_t>((leaves * widest_bar + most - 1) / most);
        std::cout << "    " << std::setw(2) << size << std::setw(10) << leaves << "  " << std::string(bar, '#') << '\n';
    }
}

}  // namespace

Json tree_quality_json(const TreeQuality& quality) {
    Json levels = Json::array();
    for (const LevelQuality& level : quality.levels) levels.push_back(level_json(level));
    Json sizes = Json::array();
    for (std::size_t size = 0; size < quality.leaves_of_size.size(); ++size)
        if (quality.leaves_of_size[size] != 0)
            sizes.push_back({{"triangles", size}, {"leaves", quality.leaves_of_size[size]}});
    return {{"levels", std::move(levels)},
            {"all", level_json(quality.all)},
            {"triangle_areas", quality.triangle_areas},
            {"leaf_depth",
             {{"least", quality.least_leaf_depth},
              {"mean", quality.mean_leaf_depth},
              {"greatest", quality.greatest_leaf_depth},
              {"full", quality.full_leaf_depth}}},
            {"children_per_node", quality.children_per_node},
            {"leaf_sizes", std::move(sizes)}};
}

void print_tree_quality(const TreeQuality& quality) {
    if (quality.levels.empty()) {
        std::cout << "  no triangles, and so no boxes\n";
        return;
    }
    print_levels(quality);
    print_balance(quality);
    print_leaves(quality);
}

}  // namespace espalier::tools
