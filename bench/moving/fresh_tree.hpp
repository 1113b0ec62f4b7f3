// A tree over boxes that is built with all of them at hand, for comparison.
#pragma once

#include <cstddef>
#include <span>

#include <espalier/shapes.hpp>

namespace espalier::bench {

/// What a tree with up to eight children a node is like.
struct TreeShape {
    double area = 0.0;  ///< the sum of half the surfaces of all boxes in nodes, for each object
    double fill = 0.0;  ///< children of a node, the mean
    std::size_t nodes = 0;
    std::size_t depth = 0;  ///< nodes on the longest way
};

/// Builds a tree from the top down: the largest part of a node is split in two at the best of 16 bins along each axis
/// (surface area heuristic), until there are eight parts or none has more than eight objects.
TreeShape fresh_tree(std::span<const Box> boxes);

}  // namespace espalier::bench
