// What the tree of a moving scene is like, and what a step costs it, in counts.
#pragma once

#include <cstdint>

#include <runtime/moving_scenes/box_tree/block.hpp>

#include "fresh_tree.hpp"

namespace espalier::bench {

/// Returns its shape; areas are in squares of the length whose exponent is that of the steps.
TreeShape shape_of(const detail::SceneBlock& block, int step_exponent);

/// Returns how many tests of a box against a node's boxes the search for pairs took in the step that ended last: for
/// all pairs, or those in which something moved.
std::uint64_t count_box_tests(const detail::SceneBlock& block, bool only_moved);

}  // namespace espalier::bench
