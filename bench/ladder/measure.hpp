// The same queries in trees of every layout and every degree.
#pragma once

#include <cstddef>

#include "../rays.hpp"

namespace espalier::bench {

struct LadderOptions {
    unsigned leaf_triangles = 4;
    std::size_t rays = 20'000;
    std::size_t boxes = 2'000;
    std::size_t recounted = 100;
    std::size_t rounds = 5;
};

/// Prints a row for each step of the ladder and for each degree. Throws std::runtime_error if a tree has other answers
/// than the others, or if two counters differ for one of the first `recounted` rays and boxes.
void measure_ladder(Mesh mesh, const LadderOptions& options);

}  // namespace espalier::bench
