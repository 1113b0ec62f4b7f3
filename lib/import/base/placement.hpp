// Where imported coordinates end up: a node's transform, the unit, the scale, the up axis, in double until the last
// step.
#pragma once

#include <array>
#include <limits>

#include <espalier/import.hpp>
#include <espalier/types.hpp>

namespace espalier::importer {

/// "+X"
const char* axis_name(Axis axis);

bool is_finite(Vec3 point);

/// A box around points. Without points, `low` is above `high`.
struct PointBox {
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    std::array<double, 3> low{infinity, infinity, infinity};
    std::array<double, 3> high{-infinity, -infinity, -infinity};

    void add(const std::array<double, 3>& point);
    void add(Vec3 point) { add(std::array{double(point.x), double(point.y), double(point.z)}); }
};

/// First `inner`, then `outer`.
Placement combine(const Placement& outer, const Placement& inner);
Placement scaled_by(double factor);
/// The rotation that takes +up to +Y; it exchanges coordinates and signs, so it is exact.
Placement turned_to_y_up(Axis up);

}  // namespace espalier::importer
