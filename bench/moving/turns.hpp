// Systems that take turns at the steps of one motion.
#pragma once

#include "broad_phase.hpp"

namespace espalier::bench::moving {

/// The seconds of each step, the least of all repeats.
using Steps = std::vector<double>;

struct Measured {
    std::string name;
    std::string from;
    Finds finds = Finds::all;
    Steps steps;                          ///< processor time of the thread
    std::array<Steps, part_count> parts;  ///< elapsed time
    std::size_t pairs = 0;                ///< in the last step
    std::size_t differing_steps = 0;      ///< in which pairs are missing or wrong, in the first repeat
    std::size_t differing_pairs = 0;      ///< of all those steps
};

double mean_of(const Steps& steps);
double slowest_of(const Steps& steps);

/// Runs all systems through the same steps, ten in a turn, and again for each repeat: a turn then begins at other
/// steps, so that each step is measured with the system's memory in the cache. Unmeasured steps come first: systems
/// with a history, such as boxes with margins that all begin to be left at the same time, are then in a usual state.
///
/// `colliding` compares pairs of triangles that touch in place of those of boxes.
std::vector<Measured> measure(const BroadPhaseMakers& makers, const Scenario& scenario, const BakeResult& mesh,
                              bool colliding = false);

/// Leaves out the systems that the scenario does not name. Throws std::invalid_argument for a name of no system.
BroadPhaseMakers selected(BroadPhaseMakers makers, const Scenario& scenario);

// What was measured, as rows.

/// Returns a row with the scenario and the machine, to which figures are added.
JsonObject row_of(const Scenario& scenario, const std::string& measures);

/// Prints the rows. A system that takes boxes has a second row for placements, with the time of the loop that makes
/// boxes. A ratio is its time by that of the first system, from the same input.
void print_steps(const std::vector<Measured>& measured, const Scenario& scenario, const std::string& measures);

// How good a tree stays while its boxes move, and how even the work of its steps is.

/// Moves the tree that many steps, without a measurement of time, and prints a row: its area beside that of a fresh
/// tree in the last steps, and the slowest step in counted work beside the median one.
void print_upkeep(const Scenario& scenario, std::size_t steps);

// A tree from which random boxes are removed and into which others are inserted, and which is never packed.

/// Inserts the scenario's objects, then removes one and inserts one so many times. Prints a row: area beside that of a
/// fresh tree, depth, fill, and the time of an operation.
void print_churn(const Scenario& scenario, std::size_t operations);

}  // namespace espalier::bench::moving
