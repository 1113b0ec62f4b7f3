// Triangles of the tree as the tests of triangles take them: in double.
#pragma once

#include "../volumes/tests.hpp"
#include "aabb_tree.hpp"

namespace espalier::bench {

inline Point point_of(const Vec3& p) {
    return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}

inline Corners3 corners_of(const FloatTriangle& triangle) {
    return {point_of(triangle[0]), point_of(triangle[1]), point_of(triangle[2])};
}

}  // namespace espalier::bench
