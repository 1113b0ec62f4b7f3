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

/// Whether float32 moves a coordinate, by half its spacing, farther than a quarter of a step.
[[nodiscard]] inline bool is_too_coarse(double coordinate, double step) {
    return std::ldexp(1.0, exponent_of(coordinate) - std::numeric_limits<float>::digits - 1) > step / 4;
}

/// Returns a place near the middle of a box whose largest side is `side`, a finite one above 0. It is a multiple of a
/// power of two above the side, and so of any step in the box.
[[nodiscard]] inline Vec3d origin_near_middle(const Vec3d& min, const Vec3d& max, double side) {
    const double spacing = std::ldexp(1.0, exponent_of(side));
    const auto near_middle = [&](double low, double high) {
        return std::nearbyint((0.5 * low + 0.5 * high) / spacing) * spacing + 0.0;
    };
    return {near_middle(min.x, max.x), near_middle(min.y, max.y), near_middle(min.z, max.z)};
}

}  // namespace espalier::baker
