// Builders from the textbook, for comparison alone: what the surface area heuristic is better than.
#pragma once

#include <cstdint>

#include <baker/build/binary_tree.hpp>
#include <baker/build/settings.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::bench {

/// How a node's triangles are parted: "Real-Time Collision Detection" (Ericson 2005), section 6.2.1. The first three
/// choose the axis in which the centres spread most, and a place on it; the others try every place along every axis and
/// take the best by their objective, of equals the one closest to the middle.
enum class Textbook : std::uint8_t {
    object_median,         ///< as many triangles on one side as on the other
    object_mean,           ///< at the mean of the centres
    spatial_median,        ///< at the middle of the box around the centres
    minimum_sum,           ///< of the children's areas
    minimum_maximum,       ///< of the children's areas
    minimum_intersection,  ///< of the children's boxes, by area
    maximum_separation,    ///< of the children's boxes along the axis
};

/// As baker::build. One thread.
[[nodiscard]] baker::BinaryTree build_textbook(const baker::LatticeMesh& mesh, Textbook rule,
                                               const baker::BuildSettings& settings);

}  // namespace espalier::bench
