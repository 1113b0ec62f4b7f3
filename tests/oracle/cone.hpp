// Whether a cone and a triangle share a point, by the largest value of a quadratic function, in rationals.
#pragma once

#include "exact_geometry.hpp"

namespace espalier::oracle {

/// The convex hull of the apex and a disc around apex + axis, which is perpendicular to the axis.
struct Cone {
    Point apex;
    Point axis;
    Rational radius;
};

/// Returns whether they share a point. The triangle may have no area, the axis must have a length.
bool meets(const Cone& cone, const Triangle& triangle);

}  // namespace espalier::oracle
