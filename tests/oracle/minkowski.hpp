// How far two convex bodies are apart, or how deep they are in each other, in double: by the differences of all their
// vertices. Tries every plane and triangle through three of these, so that no case is forgotten.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "double_geometry.hpp"

namespace espalier::reference {

/// The least gap below which `direction`, of unit length, separates: of a from b, so that a is ahead.
inline double gap_along(Point direction, const std::vector<Point>& a, const std::vector<Point>& b) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Point& p : a) low = std::min(low, dot(direction, p));
    for (const Point& p : b) high = std::max(high, dot(direction, p));
    return low - high;
}

/// Returns the point of a segment that is closest to the origin.
inline Point closest_on_side(Point a, Point b) {
    const Point side = b - a;
    const double squared = dot(side, side);
    return a + (squared > 0.0 ? std::clamp(-dot(a, side) / squared, 0.0, 1.0) : 0.0) * side;
}

/// Returns the point of a triangle, with an area or without, that is closest to the origin.
inline Point closest_to_origin(const PointTriangle& t) {
    const Point normal = normal_of(t);
    const double area = dot(normal, normal);
    bool inside = area > 0.0;
    Point closest = t[0];
    for (unsigned k = 0; k < 3; ++k) {
        const Point &a = t[k], &b = t[(k + 1) % 3];
        inside = inside && dot(cross(b - a, -1.0 * a), normal) >= 0.0;
        const Point on_side = closest_on_side(a, b);
        if (dot(on_side, on_side) < dot(closest, closest)) closest = on_side;
    }
    return inside ? (dot(t[0], normal) / area) * normal : closest;
}

/// Returns the distance of two convex hulls, or minus the length of the shortest translation that separates them.
inline double signed_separation(const std::vector<Point>& a, const std::vector<Point>& b) {
    std::vector<Point> differences;
    for (const Point& p : a)
        for (const Point& q : b) differences.push_back(p - q);
    double size = 0.0;
    for (const Point& p : differences) size = std::max(size, length(p));
    Point nearest = differences[0];
    double depth = std::numeric_limits<double>::infinity();
    const std::size_t count = differences.size();
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = i; j < count; ++j) {
            for (std::size_t k = j; k < count; ++k) {
                const PointTriangle triangle = {differences[i], differences[j], differences[k]};
                const Point closest = closest_to_origin(triangle), normal = normal_of(triangle);
                if (dot(closest, closest) < dot(nearest, nearest)) nearest = closest;
                const double size_of_normal = length(normal);
                if (size_of_normal <= 1e-12 * size * size) continue;
                for (const double sense : {-1.0, 1.0})
                    depth = std::min(depth, -gap_along((sense / size_of_normal) * normal, a, b));
            }
        }
    }
    // The closest point proves that they are apart; else the shortest way over all planes is the way out.
    const double distance = length(nearest);
    if (distance > 0.0 && gap_along((1.0 / distance) * nearest, a, b) > 0.0) return distance;
    return std::isinf(depth) ? 0.0 : -std::max(depth, 0.0);
}

}  // namespace espalier::reference
