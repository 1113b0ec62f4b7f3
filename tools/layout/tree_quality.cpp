#include "tree_quality.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <string>
#include <utility>

#include <espalier/format.hpp>
#include <espalier/walk.hpp>

#include <import/base/numbers.hpp>

#include "base/exit_code.hpp"

namespace espalier::tools {

namespace {

using Sides = std::array<double, 3>;

/// Returns the sides of the box that two boxes have in common, or a negative one.
Sides common_sides(const Box& a, const Box& b) {
    const auto side = [](float a_min, float a_max, float b_min, float b_max) {
        return static_cast<double>(std::min(a_max, b_max)) - static_cast<double>(std::max(a_min, b_min));
    };
    return {side(a.min.x, a.max.x, b.min.x, b.max.x), side(a.min.y, a.max.y, b.min.y, b.max.y),
            side(a.min.z, a.max.z, b.min.z, b.max.z)};
}

/// Returns 0 where a side is negative.
double half_area(const Sides& sides) {
    if (std::min({sides[0], sides[1], sides[2]}) < 0.0) return 0.0;
    return sides[0] * sides[1] + sides[1] * sides[2] + sides[2] * sides[0];
}

double volume(const Sides& sides) { return sides[0] * sides[1] * sides[2]; }

/// Adds up the boxes of a tree, node by node.
class Sums {
public:
    /// Takes the root before all others.
    void add(const TreeNode& node) {
        if (node.number == 0) take_whole(node);
        if (quality_.levels.size() < node.depth) quality_.levels.resize(node.depth);
        LevelQuality& level = quality_.levels[node.depth - 1];
        ++nodes_;
        children_ += node.child_count;
        for (unsigned i = 0; i < node.child_count; ++i) {
            const TreeChild& child = node.children[i];
            const Sides sides = common_sides(child.box, child.box);
            const double area = share(half_area(sides), whole_area_);
            level.volumes += share(volume(sides), whole_volume_);
            if (child.is_leaf) add_leaf(level, node.depth, child.count, area);
            else ++level.nodes, level.node_areas += area;
            for (unsigned j = 0; j < i; ++j)
                level.shared_areas += share(half_area(common_sides(child.box, node.children[j].box)), whole_area_);
        }
    }
    [[nodiscard]] TreeQuality take() {
        for (const LevelQuality& level : quality_.levels) {
            quality_.all.nodes += level.nodes;
            quality_.all.leaves += level.leaves;
            quality_.all.triangles += level.triangles;
            quality_.all.node_areas += level.node_areas;
            quality_.all.leaf_areas += level.leaf_areas;
            quality_.all.volumes += level.volumes;
            quality_.all.shared_areas += level.shared_areas;
        }
        if (nodes_ != 0) quality_.children_per_node = static_cast<double>(children_) / static_cast<double>(nodes_);
        const auto leaves = static_cast<double>(quality_.all.leaves);
        if (leaves > 0.0) quality_.mean_leaf_depth = depths_ / leaves;
        if (leaves > 0.0) quality_.full_leaf_depth = std::max(1.0, std::log(leaves) / std::log(most_children_));
        return quality_;
    }
    explicit Sums(unsigned most_children) : most_children_(most_children) {}

private:
    static double share(double part, double whole) { return whole > 0.0 ? part / whole : 0.0; }

    void take_whole(const TreeNode& root) {
        Box whole = root.children[0].box;
        for (unsigned i = 1; i < root.child_count; ++i) {
            const Box& box = root.children[i].box;
            whole.min = {std::min(whole.min.x, box.min.x), std::min(whole.min.y, box.min.y),
                         std::min(whole.min.z, box.min.z)};
            whole.max = {std::max(whole.max.x, box.max.x), std::max(whole.max.y, box.max.y),
                         std::max(whole.max.z, box.max.z)};
        }
        whole_area_ = half_area(common_sides(whole, whole));
        whole_volume_ = volume(common_sides(whole, whole));
    }
    void add_leaf(LevelQuality& level, unsigned depth, std::uint32_t triangles, double area) {
        if (depths_ == 0.0) quality_.least_leaf_depth = depth;
        ++level.leaves;
        level.triangles += triangles;
        level.leaf_areas += area;
        quality_.triangle_areas += area * triangles;
        if (quality_.leaves_of_size.size() <= triangles) quality_.leaves_of_size.resize(triangles + 1);
        ++quality_.leaves_of_size[triangles];
        quality_.least_leaf_depth = std::min(quality_.least_leaf_depth, depth);
        quality_.greatest_leaf_depth = std::max(quality_.greatest_leaf_depth, depth);
        depths_ += depth;
    }

    TreeQuality quality_;
    unsigned most_children_;
    double whole_area_ = 0.0, whole_volume_ = 0.0, depths_ = 0.0;
    std::uint64_t nodes_ = 0, children_ = 0;
};

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

TreeQuality tree_quality_of(const Blob& blob) {
    Sums sums(format::max_node_children(blob.profile()));
    // The visitor never stops it, and a blob that was opened is never refused.
    static_cast<void>(for_each_node(blob, [&](const TreeNode& node) {
        sums.add(node);
        return NodeVisit::descend;
    }));
    return sums.take();
}

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
