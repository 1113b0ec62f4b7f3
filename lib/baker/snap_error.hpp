// The way that snapping moves a point, without rounding error worth mentioning.
#pragma once

#include <cmath>

#include "lattice.hpp"

namespace espalier::baker {

/// More than what rounding takes from a sum of squares and its root.
inline constexpr double rounding_margin = 1.0 + 0x1p-50;

/// Coordinate minus lattice coordinate. The difference of coordinate and origin is taken as a sum without rounding
/// error (two-sum), the lattice part subtracted from it exactly.
[[nodiscard]] inline double snap_error(float coordinate, float origin, double steps, double step) {
    const double a = double(coordinate);
    const double b = -double(origin);
    const double sum = a + b;
    const double virtual_part = sum - a;
    const double lost = (a - (sum - virtual_part)) + (b - virtual_part);
    return (sum - steps * step) + lost;
}

/// The square of the distance between a point and the lattice point that stands for it, up to rounding_margin.
[[nodiscard]] inline double square_snap_error(const Vec3& point, const Vec3& origin, const LatticePoint& snapped,
                                              double step) {
    const double x = snap_error(point.x, origin.x, snapped.x, step);
    const double y = snap_error(point.y, origin.y, snapped.y, step);
    const double z = snap_error(point.z, origin.z, snapped.z, step);
    return x * x + y * y + z * z;
}

}  // namespace espalier::baker
