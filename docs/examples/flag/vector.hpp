// Whole numbers in the place of floats, so that every compiler gives the same motion.
#pragma once

#include <cstdint>

#include <espalier/types.hpp>

namespace flag {

/// A position in units of 2^-12 m, or a velocity in units for each step of 1/64 s.
struct Vector {
    std::int32_t x, y, z;
};
constexpr std::int32_t metre = 1 << 12;
constexpr std::int32_t steps_per_second = 64;

/// Returns a position in metres.
inline espalier::Vec3 in_metres(const Vector& position) {
    return {static_cast<float>(position.x) / metre, static_cast<float>(position.y) / metre,
            static_cast<float>(position.z) / metre};
}

/// A direction of unit length, in units of 2^-10.
constexpr std::int32_t unit = 1 << 10;
inline Vector in_units(const espalier::Vec3& direction) {
    return {static_cast<std::int32_t>(direction.x * unit), static_cast<std::int32_t>(direction.y * unit),
            static_cast<std::int32_t>(direction.z * unit)};
}

inline std::int64_t dot(const Vector& a, const Vector& b) {
    return std::int64_t{a.x} * b.x + std::int64_t{a.y} * b.y + std::int64_t{a.z} * b.z;
}
/// Adds a share of a vector, numerator / denominator.
inline void add(Vector& to, const Vector& way, std::int64_t numerator, std::int64_t denominator) {
    to.x += static_cast<std::int32_t>(way.x * numerator / denominator);
    to.y += static_cast<std::int32_t>(way.y * numerator / denominator);
    to.z += static_cast<std::int32_t>(way.z * numerator / denominator);
}

}  // namespace flag
