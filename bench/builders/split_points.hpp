// Top-down construction that chooses an axis and then a point on it.
#pragma once

#include <cstdint>

#include <baker/build/binary_tree.hpp>
#include <baker/build/settings.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::bench {

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

}  // namespace espalier::bench
