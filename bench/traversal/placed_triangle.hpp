// A triangle of the second tree, placed beside the first: which triangles touch it.
#pragma once

#include "../volumes/tests.hpp"
#include "aabb_tree.hpp"

namespace espalier::bench {

/// A triangle in a pose, with its plane. It is tested as in "Faster triangle-triangle intersection tests" (Devillers,
/// Guigue 2002), in double. Where a corner is too close to the other triangle's plane for its side to be certain, all
/// separating axes are tested instead.
class PlacedTriangle {
public:
    /// No coordinate of a triangle, placed or not, is larger than `largest`.
    PlacedTriangle(const FloatTriangle& triangle, const Pose& pose, double largest);
    [[nodiscard]] bool touches(const FloatTriangle& triangle) const;

private:
    Corners3 corners_;
    Point normal_;
    double height_;    ///< of the plane, along the normal
    double rounding_;  ///< of a height, for each unit of the normal
    double slack_;     ///< a height above the plane that is less than this has no certain sign
};

}  // namespace espalier::bench
