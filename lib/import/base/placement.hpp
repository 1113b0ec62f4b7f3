// Where imported coordinates end up: a node's transform, the unit, the scale, the up axis, in double until the last
// step.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include <espalier/types.hpp>

namespace espalier::importer {

enum class Axis : std::uint8_t { x, y, z };

/// "+X"
const char* axis_name(Axis axis);

bool is_finite(Vec3 point);

/// point -> linear * point + offset
struct Placement {
    std::array<std::array<double, 3>, 3> linear{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    std::array<double, 3> offset{};

    /// Rounds the result once.
    [[nodiscard]] Vec3 operator()(const std::array<double, 3>& point) const;
    [[nodiscard]] Vec3 operator()(Vec3 point) const;
    /// Turns the inside out, so that the corners of a triangle must be taken the other way round.
    [[nodiscard]] bool mirrors() const;
    [[nodiscard]] double determinant() const;
};

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
