// Arithmetic with places in float64.
#pragma once

#include <cmath>

#include <espalier/transform.hpp>
#include <espalier/types.hpp>

namespace espalier::tools {

inline Vec3d operator+(const Vec3d& a, const Vec3d& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3d operator-(const Vec3d& a, const Vec3d& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3d operator*(double factor, const Vec3d& a) { return {factor * a.x, factor * a.y, factor * a.z}; }
inline double dot(const Vec3d& a, const Vec3d& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3d cross(const Vec3d& a, const Vec3d& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length_of(const Vec3d& a) { return std::hypot(a.x, a.y, a.z); }

/// Rotates a point. A quaternion may have any length but zero.
inline Vec3d turned(const Quaternion& by, const Vec3d& point) {
    const Vec3d axis = {double(by.x), double(by.y), double(by.z)};
    const auto w = double(by.w);
    const Vec3d once = cross(axis, point), again = cross(axis, once);
    const double twice = 2.0 / (dot(axis, axis) + w * w);
    return {point.x + twice * (w * once.x + again.x), point.y + twice * (w * once.y + again.y),
            point.z + twice * (w * once.z + again.z)};
}

}  // namespace espalier::tools
