// Arithmetic with places in float64.
#pragma once

#include <cmath>

#include <espalier/types.hpp>

namespace espalier::tools {

inline Vec3d operator-(const Vec3d& a, const Vec3d& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3d operator*(double factor, const Vec3d& a) { return {factor * a.x, factor * a.y, factor * a.z}; }
inline double dot(const Vec3d& a, const Vec3d& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3d cross(const Vec3d& a, const Vec3d& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length_of(const Vec3d& a) { return std::hypot(a.x, a.y, a.z); }

}  // namespace espalier::tools
