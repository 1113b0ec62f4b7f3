// How good a binary tree is, before it becomes a blob.
#pragma once

#include <optional>

#include <baker/build/binary_tree.hpp>

namespace espalier::bench {

/// Sums are over the root's own value.
struct BinaryTreeQuality {
    /// Of the areas of nodes with children: how many of them a random line through the root's box is expected to meet.
    double inner_areas = 0.0;
    /// Of the areas of leaves, which hold a triangle each: how many of them such a line is expected to meet.
    double leaf_areas = 0.0;
    /// Of the volumes of all nodes; nothing where the root has none.
    std::optional<double> volumes;
    unsigned height = 0;

    /// The cost of the surface area heuristic (Goldsmith, Salmon 1987; MacDonald, Booth 1990) with a price of 1 for a
    /// node and for a triangle.
    [[nodiscard]] double sah_cost() const { return inner_areas + leaf_areas; }
};

/// The tree must have a triangle at least.
[[nodiscard]] BinaryTreeQuality quality_of(const baker::BinaryTree& tree);

}  // namespace espalier::bench
