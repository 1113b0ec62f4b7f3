#include "layout/tree_quality.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <espalier/format.hpp>
#include <espalier/walk.hpp>

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

}  // namespace espalier::tools
