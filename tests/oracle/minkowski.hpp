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

/// The differences of all vertices, and the largest of their lengths.
struct Differences {
    std::vector<Point> points;
    double size = 0.0;

    Differences(const std::vector<Point>& a, const std::vector<Point>& b) {
        for (const Point& p : a)
            for (const Point& q : b) points.push_back(p - q);
        for (const Point& p : points) size = std::max(size, length(p));
    }
    /// Calls function(triangle) with each three, in which a point may be repeated.
    template <class Function>
    void for_each_triangle(const Function& function) const {
        for (std::size_t i = 0; i < points.size(); ++i)
            for (std::size_t j = i; j < points.size(); ++j)
                for (std::size_t k = j; k < points.size(); ++k)
                    function(PointTriangle{points[i], points[j], points[k]});
    }
};

/// Calls function(direction, gap) with all directions in which a may leave b by the shortest way, and more: those
/// across three differences of vertices. The gap is below 0 by how far a has to go.
template <class Function>
void for_each_way_out(const std::vector<Point>& a, const std::vector<Point>& b, const Function& function) {
    const Differences differences(a, b);
    differences.for_each_triangle([&](const PointTriangle& triangle) {
        const Point normal = normal_of(triangle);
        const double size_of_normal = length(normal);
        if (size_of_normal <= 1e-12 * differences.size * differences.size) return;
        for (const double sense : {-1.0, 1.0}) {
            const Point direction = (sense / size_of_normal) * normal;
            function(direction, gap_along(direction, a, b));
        }
    });
}

/// Returns how far a, which touches b, has to go in a direction until it only touches.
inline double depth_along(Point direction, const std::vector<Point>& a, const std::vector<Point>& b) {
    double depth = std::numeric_limits<double>::infinity();
    for_each_way_out(a, b, [&](Point way, double gap) {
        const double share = dot(way, direction);
        if (share > 1e-12) depth = std::min(depth, std::max(-gap, 0.0) / share);
    });
    return depth;
}

/// Returns the distance of two convex hulls, or minus the length of the shortest translation that separates them.
inline double signed_separation(const std::vector<Point>& a, const std::vector<Point>& b) {
    const Differences differences(a, b);
    Point nearest = differences.points[0];
    differences.for_each_triangle([&](const PointTriangle& triangle) {
        const Point closest = closest_to_origin(triangle);
        if (dot(closest, closest) < dot(nearest, nearest)) nearest = closest;
    });
    // The closest point proves that they are apart; else the shortest way over all planes is the way out.
    const double distance = length(nearest);
    if (distance > 0.0 && gap_along((1.0 / distance) * nearest, a, b) > 0.0) return distance;
    double depth = std::numeric_limits<double>::infinity();
    for_each_way_out(a, b, [&](Point, double gap) { depth = std::min(depth, -gap); });
    return std::isinf(depth) ? 0.0 : -std::max(depth, 0.0);
}

}  // namespace espalier::reference
