// The words behind espalier_bench_peers rays.
#pragma once

#include "../program.hpp"
#include "contest.hpp"
#include "system.hpp"

namespace espalier::bench {

struct Options {
    std::vector<std::string> systems;  ///< NAME or NAME/PROFILE; none: all
    unsigned repetitions = 9;
    unsigned builds = 3;
    std::size_t incoherent = 500000;
    std::uint64_t seed = 2026;
    BakeSettings bake;
};

// Measures every system on one mesh: they take turns at building and at each kind of ray, so that a change of the
// machine's speed hits them alike. A ratio is taken between neighbours in time; a figure is the median of the
// repetitions' ratios, with the smallest and the largest beside it.

/// Prints one JSON object a line for each system; null where it has no such query and where there is no reference.
/// Throws std::exception when the mesh cannot be read or baked.
void measure(const std::string& path, const std::vector<Maker>& makers, const Options& options);

}  // namespace espalier::bench
