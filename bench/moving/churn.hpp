// A tree from which random boxes are removed and into which others are inserted, and which is never packed.
#pragma once

#include "scenario.hpp"

namespace espalier::bench {

/// Inserts the scenario's objects, then removes one and inserts one so many times. Prints a row to stdout and lines to
/// stderr: area beside that of a fresh tree, depth, fill, and the time of an operation.
void print_churn(const Scenario& scenario, std::size_t operations);

}  // namespace espalier::bench
