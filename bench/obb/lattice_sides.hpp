// On which side of a plane a point of a lattice is: exact.
#pragma once

#include "../volumes/shapes.hpp"

namespace espalier::bench {

/// Lattice points have whole coordinates from 0 to this, in double.
inline constexpr double lattice_steps = 0x1p40;

/// Returns a number with the sign of the determinant of b - a, c - a and p - a: positive where p is on the side from
/// which a, b, c are counterclockwise, 0 where p is in their plane.
[[nodiscard]] double side_of(const Point& a, const Point& b, const Point& c, const Point& p);

}  // namespace espalier::bench
