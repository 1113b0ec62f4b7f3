// When coordinates need an origin, and which one.
#pragma once

#include <cmath>
#include <limits>

#include <espalier/types.hpp>

namespace espalier::baker {

/// Returns the exponent of the least power of two above a value.
[[nodiscard]] inline int exponent_of(double value) {
    int exponent = 0;
    std::frexp(value, &exponent);
    return exponent;
}

/// Returns the least power of two above a value.
[[nodiscard]] inline double power_above(double value) { return std::ldexp(1.0, exponent_of(value)); }

/// Whether float32 moves a coordinate, by half its spacing, farther than a quarter of a step.
[[nodiscard]] inline bool is_too_coarse(double coordinate, double step) {
    return std::ldexp(1.0, exponent_of(coordinate) - std::numeric_limits<float>::digits - 1) > step / 4;
}

/// Returns the multiple of a spacing that is nearest to the middle of a box. A spacing is a power of two.
[[nodiscard]] inline Vec3d origin_near_middle(const Vec3d& min, const Vec3d& max, double spacing) {
    const auto near_middle = [&](double low, double high) {
        return std::nearbyint((0.5 * low + 0.5 * high) / spacing) * spacing + 0.0;
    };
    return {near_middle(min.x, max.x), near_middle(min.y, max.y), near_middle(min.z, max.z)};
}

}  // namespace espalier::baker
