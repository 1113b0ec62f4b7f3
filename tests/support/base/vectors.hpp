// Arithmetic of the library's vectors, whose type has none of its own.
#pragma once

#include <algorithm>
#include <cmath>

#include <espalier/shapes.hpp>

namespace espalier::tests {

inline Vec3 sum(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 difference(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 times(Vec3 a, float by) { return {a.x * by, a.y * by, a.z * by}; }
inline float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline Vec3 middle(Vec3 a, Vec3 b) { return times(sum(a, b), 0.5f); }
inline float largest(Vec3 a) { return std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)}); }
inline float longest_side(const Box& box) { return largest(difference(box.max, box.min)); }
inline bool is_zero(Vec3 a) { return a.x == 0.0f && a.y == 0.0f && a.z == 0.0f; }

/// Returns the length, without overflow of the squares.
inline double length(Vec3 a) {
    return std::hypot(static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z));
}

}  // namespace espalier::tests
