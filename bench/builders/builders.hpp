// Top-down construction that tries every split along every axis and takes the best by an objective.
#pragma once

#include <baker/build/binary_tree.hpp>
#include <baker/build/settings.hpp>
#include <baker/quantise/lattice_mesh.hpp>

#include "../base.hpp"

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

// Top-down construction that chooses an axis and then a point on it.

/// How the axis is chosen: the four rules that "Efficient collision detection using bounding volume hierarchies of
/// k-DOPs" (Klosowski, Held, Mitchell, Sowizral, Zikan 1998) compares. They compare volumes; here it is areas, since a
/// wall along an axis has no volume.
enum class SplitAxis : std::uint8_t {
    longest_side,       ///< of the box around the centres
    greatest_variance,  ///< of the centres; there called "splatter"
    least_sum,          ///< of the children's areas, over the split points of all axes
    least_maximum,      ///< of the children's areas, over the split points of all axes
};

/// Where the axis is split: "Real-Time Collision Detection" (Ericson 2005), section 6.2.1.
enum class SplitPoint : std::uint8_t {
    object_median,   ///< as many triangles on one side as on the other
    object_mean,     ///< at the mean of the centres
    spatial_median,  ///< at the middle of the box around the centres
};

/// Builds as baker::build does, on one thread. Where a point leaves one side empty, the object median takes its place.
[[nodiscard]] baker::BinaryTree build_at_points(const baker::LatticeMesh& mesh, SplitAxis axis, SplitPoint point,
                                                const baker::BuildSettings& settings);

// The builders that are compared: those of the library, and those of the textbook.

struct NamedBuilder {
    std::string family;  ///< what the builder has in common with some of the others
    std::string name;
    /// Builds as baker::build does. Of the settings a builder may replace those that its name states.
    std::function<baker::BinaryTree(const baker::LatticeMesh&, baker::BuildSettings)> build;
};

/// Returns all of them. The first one is binned SAH with 32 bins, the library's default.
std::vector<NamedBuilder> all_builders();

}  // namespace espalier::bench
