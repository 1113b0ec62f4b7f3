// Systems that take turns at the steps of one motion.
#pragma once

#include <optional>

#include "broad_phase.hpp"

namespace espalier::bench {

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

double median_of(Steps steps);
double mean_of(const Steps& steps);
double slowest_of(const Steps& steps);

/// Runs all systems through the same steps, ten in a turn, and again for each repeat: a turn then begins at other
/// steps, so that each step is measured with the system's memory in the cache. Unmeasured steps come first: systems
/// with a history, such as boxes with margins that all begin to be left at the same time, are then in a usual state.
///
/// `colliding` compares pairs of triangles that touch in place of those of boxes.
std::vector<Measured> measure(const BroadPhaseMakers& makers, const Scenario& scenario, const BakeResult& mesh,
                              bool colliding = false);

/// Returns the measured system, or nothing.
const Measured* find_measured(const std::vector<Measured>& all, const std::string& name, const std::string& from);

/// Leaves out the systems that the scenario does not name. Throws std::invalid_argument for a name of no system.
BroadPhaseMakers selected(BroadPhaseMakers makers, const Scenario& scenario);

}  // namespace espalier::bench
