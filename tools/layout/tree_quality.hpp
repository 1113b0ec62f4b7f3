// How good the tree of a blob is: areas, volumes and overlap of its boxes, its balance, and the sizes of its leaves.
#pragma once

#include <cstdint>
#include <vector>

#include <espalier/blob.hpp>

#include "report/json.hpp"

namespace espalier::tools {

/// The boxes at one depth. The root's children, nodes and leaves, have depth 1. Areas and volumes are sums over those
/// of the whole tree's box.
struct LevelQuality {
    std::uint64_t nodes = 0;
    std::uint64_t leaves = 0;
    std::uint64_t triangles = 0;  ///< in these leaves, duplicate references included
    double node_areas = 0.0;
    double leaf_areas = 0.0;
    double volumes = 0.0;
    /// Of the areas that boxes have in common with a sibling: summed over pairs of siblings.
    double shared_areas = 0.0;

    [[nodiscard]] double areas() const { return node_areas + leaf_areas; }
};

/// A random line that meets the whole box is expected to meet a box in it with the ratio of their areas (MacDonald,
/// Booth 1990). So sums of areas are expected numbers of visits.
struct TreeQuality {
    std::vector<LevelQuality> levels;
    LevelQuality all;           ///< of all levels
    double triangle_areas = 0;  ///< of leaves, each times its triangles: the expected tests of triangles
    /// Leaves that have so many triangles; the first has none.
    std::vector<std::uint64_t> leaves_of_size;
    unsigned least_leaf_depth = 0;
    double mean_leaf_depth = 0.0;
    unsigned greatest_leaf_depth = 0;
    /// Of a tree with as many leaves in which every node is full.
    double full_leaf_depth = 0.0;
    double children_per_node = 0.0;
};

/// Reads the whole tree of a blob that was opened. Cost: O(nodes).
[[nodiscard]] TreeQuality tree_quality_of(const Blob& blob);

[[nodiscard]] Json tree_quality_json(const TreeQuality& quality);
/// Prints three tables: of levels, of balance and of leaves.
void print_tree_quality(const TreeQuality& quality);

}  // namespace espalier::tools
