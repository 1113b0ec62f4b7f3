// Counts the work of walks in builds with the CMake option ESPALIER_COUNT_STEPS, so that tests can hold every query to
// the bound that it states. In other builds nothing is counted and no code is made.
#pragma once

#include <cstdint>

#ifndef ESPALIER_COUNT_STEPS
#define ESPALIER_COUNT_STEPS 0
#endif

namespace espalier::detail {

#if ESPALIER_COUNT_STEPS

struct StepCounter {
    std::uint64_t nodes = 0;   ///< tests of a node's children, by one ray, shape or box
    std::uint64_t leaves = 0;  ///< visits of a leaf
    /// Triangles that lanes and bounds left open, decided by the exact kernels of rays, points and volumes.
    std::uint64_t decisions = 0;
    /// Axes along which boxes of two blobs were looked at, those of a vector register at once; in small code also those
    /// across a ray along which a box was.
    std::uint64_t axes = 0;
};
inline thread_local constinit StepCounter step_counter;

inline void count_node_step() { ++step_counter.nodes; }
inline void count_leaf_step() { ++step_counter.leaves; }
inline void count_decision() { ++step_counter.decisions; }
inline void count_axes(unsigned axes) { step_counter.axes += axes; }

#else

constexpr void count_node_step() {}
constexpr void count_leaf_step() {}
constexpr void count_decision() {}
constexpr void count_axes(unsigned) {}

#endif

}  // namespace espalier::detail
