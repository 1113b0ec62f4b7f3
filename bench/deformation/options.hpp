// What a run measures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace espalier::bench {

struct Options {
    std::size_t cloth = 100;         ///< squares along a side; 0: no cloth
    std::size_t times = 4;           ///< poses of each motion
    std::size_t rounds = 3;          ///< the median counts
    std::size_t rays = 100'000;      ///< into each pose
    unsigned bits = 16;              ///< of the lattice over the range of motion
    std::vector<std::string> parts;  ///< what to measure; all if it is empty
    std::vector<std::string> only;   ///< systems that refit; all if it is empty
};

inline constexpr std::uint64_t deformation_seed = 2026;

}  // namespace espalier::bench
