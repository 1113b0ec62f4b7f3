// Top-down construction that tries every split along every axis and takes the best by an objective.
#pragma once

#include <cstdint>

#include <baker/build/binary_tree.hpp>
#include <baker/build/settings.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::bench {

/// What makes one split better than another: the partitioning strategies of "Real-Time Collision Detection" (Ericson
/// 2005), section 6.2.1. Dividing equally is SplitPoint::object_median.
enum class Objective : std::uint8_t {
    sum_of_volumes,         ///< least
    sum_of_areas,           ///< least
    maximum_area,           ///< least, of the larger child
    intersection_area,      ///< least; children that are apart are better than ones that touch
    separation,             ///< greatest, along the axis
    bounded_sum_of_areas,   ///< least, among splits that leave a third of the triangles or more on each side
    weighted_sum_of_areas,  ///< least, each area times its number of triangles: the surface area heuristic
};

/// Builds as baker::build does, on one thread. Of splits that are equally good the one closest to the middle is taken.
[[nodiscard]] baker::BinaryTree build_by_objective(const baker::LatticeMesh& mesh, Objective objective,
                                                   const baker::BuildSettings& settings);

}  // namespace espalier::bench
