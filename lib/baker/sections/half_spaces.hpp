// Convex bodies as intersections of half-spaces.
#pragma once

#include <span>
#include <vector>

namespace espalier::baker {

struct Point {
    double x, y, z;
};
inline Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Point operator*(double s, const Point& a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Point cross(const Point& a, const Point& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// All points with dot(normal, point) <= offset.
struct HalfSpace {
    Point normal;
    double offset;
};

/// The face that lies on each half-space's plane, as a polygon; none where the plane only touches. No normal is
/// parallel to 4 2 1, and no two half-spaces are the same. The body lies within `size` of the origin.
[[nodiscard]] std::vector<std::vector<Point>> faces_of(std::span<const HalfSpace> half_spaces, double size);

}  // namespace espalier::baker
