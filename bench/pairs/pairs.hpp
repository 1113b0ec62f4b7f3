// Systems that are asked about a mesh together with a second one of the same kind, in many poses.
#pragma once

#include "../peers/contest.hpp"

namespace espalier::bench {

using PoseContest = Contest<Transform, double>;

/// Each has the systems that have such a query.
struct PairContests {
    PoseContest yes_no;
    PoseContest all;  ///< how many pairs, or contacts where the system says contacts
    PoseContest distance;
};

// Each adds what the system answers, where it is installed. The mesh outlives it.
void add_fcl_pairs(const Mesh& mesh, PairContests& to);
void add_ode_pairs(const Mesh& mesh, PairContests& to);

}  // namespace espalier::bench
