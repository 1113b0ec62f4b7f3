// How good a tree stays while its boxes move, and how even the work of its steps is.
#pragma once

#include "scenario.hpp"

namespace espalier::bench {

/// Moves the tree that many steps, without a measurement of time, and prints a row to stdout and lines to stderr:
/// its area beside that of a fresh tree in the last steps, and the slowest step in counted work beside the median one.
void print_upkeep(const Scenario& scenario, std::size_t steps);

}  // namespace espalier::bench
