// The way that snapping moves a point.
#pragma once

#include <cmath>

#include <baker/quantise/lattice.hpp>

namespace espalier::baker {

/// More than what rounding takes from a sum of squares and its root.
inline constexpr double rounding_margin = 1.0 + 0x1p-50;

/// The square of the distance between a point and the lattice point that stands for it, up to rounding_margin: a
/// lattice coordinate is a float32 number, and the difference to it is rounded by 2^-53 of itself.
[[nodiscard]] inline double square_snap_error(const Vec3d& point, const Vec3& origin, const LatticePoint& snapped,
                                              double step) {
    const auto difference = [&](double coordinate, float from, std::int32_t steps) {
        return coordinate - (double(from) + steps * step);
    };
    const double x = difference(point.x, origin.x, snapped.x);
    const double y = difference(point.y, origin.y, snapped.y);
    const double z = difference(point.z, origin.z, snapped.z);
    return x * x + y * y + z * z;
}

}  // namespace espalier::baker
