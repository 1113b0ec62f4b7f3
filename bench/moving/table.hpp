// What was measured, for people and as rows.
#pragma once

#include "../json_object.hpp"
#include "turns.hpp"

namespace espalier::bench {

/// Returns a row with the scenario and the machine, to which figures are added.
JsonObject row_of(const Scenario& scenario, const std::string& measures);

/// Prints the rows to stdout and a table to stderr. A system that takes boxes has a second row for placements, with the
/// time of the loop that makes boxes. A ratio is its time by that of the first system, from the same input.
void print_steps(const std::vector<Measured>& measured, const Scenario& scenario, const std::string& measures);

}  // namespace espalier::bench
