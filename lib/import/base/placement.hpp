// Where imported coordinates end up: a node's transform, the unit, the scale, the up axis, all in float64.
#pragma once

#include <array>
#include <limits>

#include <espalier/import.hpp>
#include <espalier/types.hpp>

namespace espalier::importer {

/// "+X"
const char* axis_name(Axis axis);

/// Returns the nearest float32 number, which is infinite for those beyond float32.
float to_float32(double number);
inline Vec3 to_float32(const Vec3d& point) { return {to_float32(point.x), to_float32(point.y), to_float32(point.z)}; }
inline Vec3d to_float64(const Vec3& point) { return {double(point.x), double(point.y), double(point.z)}; }

bool is_finite(Vec3 point);
/// Returns whether no coordinate is NaN, infinite or beyond float32.
bool is_finite(const Vec3d& point);

/// A box around points. Without points, `low` is above `high`.
struct PointBox {
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    std::array<double, 3> low{infinity, infinity, infinity};
    std::array<double, 3> high{-infinity, -infinity, -infinity};

    void add(const Vec3d& point);
};

/// First `inner`, then `outer`.
Placement combine(const Placement& outer, const Placement& inner);
Placement scaled_by(double factor);
/// The rotation that takes +up to +Y; it exchanges coordinates and signs, so it is exact.
Placement turned_to_y_up(Axis up);

}  // namespace espalier::importer
