// What the tree of a moving scene is like, and what a step costs it, in counts.
#pragma once

#include <optional>

#include <runtime/moving_scenes/box_tree/block.hpp>

#include "fresh_tree.hpp"

namespace espalier::bench {

/// Returns its shape; areas are in squares of the length whose exponent is that of the steps.
TreeShape shape_of(const detail::SceneBlock& block, int step_exponent);

/// Returns how many pairs of nodes a search for all pairs visits; with a step, for those of which one was moved in it.
std::size_t count_node_pairs(const detail::SceneBlock& block, std::optional<std::uint32_t> moved_in = {});

}  // namespace espalier::bench
