// Rounding in one direction, for bounds.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <espalier/types.hpp>

namespace espalier::baker {

[[nodiscard]] constexpr Vec3d to_float64(const Vec3& point) {
    return {double(point.x), double(point.y), double(point.z)};
}

/// The least float32 that is not below a value of zero or more; infinity above the largest one. Subnormal results
/// become the least normal number: some machines read subnormals as zero.
[[nodiscard]] inline float round_up_to_float(double value) {
    auto rounded = static_cast<float>(value);
    if (double(rounded) < value) rounded = std::bit_cast<float>(std::bit_cast<std::uint32_t>(rounded) + 1);
    return rounded != 0.0f ? std::max(rounded, std::numeric_limits<float>::min()) : rounded;
}

/// Whether float32 holds a position as it is.
[[nodiscard]] inline bool fits_float32(const Vec3d& point) {
    constexpr double beyond_float32 = 0x1.ffffffp127;  // from here on the nearest float32 is infinite
    const auto fits = [](double coordinate) {
        return std::abs(coordinate) < beyond_float32 && double(static_cast<float>(coordinate)) == coordinate;
    };
    return fits(point.x) && fits(point.y) && fits(point.z);
}

/// The greatest float32 that is at most a value.
[[nodiscard]] inline float round_down_to_float(double value) {
    const auto rounded = static_cast<float>(value);
    return double(rounded) > value ? std::nextafter(rounded, -std::numeric_limits<float>::infinity()) : rounded;
}

}  // namespace espalier::baker
