// How far one surface goes from another: not sampled, but between two numbers that are proved.
#pragma once

#include <cstddef>

#include "double_tree.hpp"

namespace espalier::reference {

/// max over the points of one surface of their distance to the other one: one way of the Hausdorff distance.
struct OneWayDistance {
    double lower = 0.0;  ///< that of some point
    double upper = 0.0;  ///< of no point more
    std::size_t pieces = 0;
};

/// Parts are halved until upper is within a thousandth of lower, or as many as `most_pieces` were looked at. Up to
/// rounding in double precision. The distance to one triangle is a convex function, so that on a piece of a triangle it
/// is largest in a corner: the least such maximum over some near triangles bounds the distance of the whole piece.
[[nodiscard]] OneWayDistance one_way_distance(const DoubleTree& from, const DoubleTree& to, std::size_t most_pieces);

}  // namespace espalier::reference
