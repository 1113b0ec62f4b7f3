// Points and triangles in double precision: the geometry that judges. It shares no code with the library.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace espalier::reference {

struct Point {
    double x = 0.0, y = 0.0, z = 0.0;
    friend Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Point operator*(double s, Point a) { return {s * a.x, s * a.y, s * a.z}; }
};

inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
/// Exactly the negative of cross(b, a): neighbours agree about the edge that they share.
inline Point cross(Point a, Point b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double length(Point a) { return std::sqrt(dot(a, a)); }

using PointTriangle = std::array<Point, 3>;

inline Point normal_of(const PointTriangle& t) { return cross(t[1] - t[0], t[2] - t[0]); }

/// In degrees, exact near 0 and near 180 too.
inline double angle_between(Point a, Point b) {
    return std::atan2(length(cross(a, b)), dot(a, b)) * (180.0 / 3.14159265358979323846);
}

inline double squared_distance_to_segment(Point p, Point a, Point b) {
    const Point side = b - a;
    const double squared = dot(side, side);
    const double s = squared > 0.0 ? std::clamp(dot(p - a, side) / squared, 0.0, 1.0) : 0.0;
    const Point apart = p - (a + s * side);
    return dot(apart, apart);
}

/// The foot of the perpendicular where it lies inside, else the nearest side. A triangle without area has sides only.
inline double squared_distance(Point p, const PointTriangle& t) {
    const Point normal = normal_of(t);
    const double area = dot(normal, normal);
    if (area > 0.0) {
        bool inside = true;
        for (unsigned k = 0; k < 3; ++k) {
            const Point a = t[k], b = t[(k + 1) % 3];
            inside = inside && dot(cross(b - a, p - a), normal) >= 0.0;
        }
        if (inside) {
            const double height = dot(p - t[0], normal);
            return height * height / area;
        }
    }
    return std::min({squared_distance_to_segment(p, t[0], t[1]), squared_distance_to_segment(p, t[1], t[2]),
                     squared_distance_to_segment(p, t[2], t[0])});
}

}  // namespace espalier::reference
