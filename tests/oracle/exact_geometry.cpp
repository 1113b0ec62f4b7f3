#include "exact_geometry.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace espalier::oracle {

namespace {

Rational inner(const Point& a, const Point& b) { return a.dot(b); }

Rational squared_length(const Point& a) { return inner(a, a); }

Rational determinant(const Point& x, const Point& y, const Point& z) {
    Eigen::Matrix<Rational, 3, 3> columns;
    columns << x, y, z;
    return columns.determinant();
}

/// The closest point of the segment: project onto its line, then stay between its ends.
ClosestPoint closest_on_segment(const Point& from, const Point& to, const Point& point) {
    const Point along = to - from;
    Rational share = inner(point - from, along) / squared_length(along);
    if (share < Rational(0)) share = 0;
    if (share > Rational(1)) share = 1;
    const Point closest = from + along * share;
    return {closest, squared_length(point - closest)};
}

}  // namespace

Point normal_of(const Triangle& triangle) {
    const Point ab = triangle.b - triangle.a;
    const Point ac = triangle.c - triangle.a;
    return ab.cross(ac);
}

// Cramer's rule on t * (-d) + u * (b - a) + v * (c - a) = o - a.
std::optional<Crossing> cross(const Line& line, const Triangle& triangle) {
    const Point against = -line.direction;
    const Point ab = triangle.b - triangle.a;
    const Point ac = triangle.c - triangle.a;
    const Point from_a = line.origin - triangle.a;
    const Rational whole = determinant(against, ab, ac);
    if (whole.sign() == 0) return std::nullopt;
    Crossing crossing;
    crossing.u = determinant(against, from_a, ac) / whole;
    if (crossing.u < Rational(0) || crossing.u > Rational(1)) return std::nullopt;
    crossing.v = determinant(against, ab, from_a) / whole;
    if (crossing.v < Rational(0) || crossing.u + crossing.v > Rational(1)) return std::nullopt;
    crossing.t = determinant(from_a, ab, ac) / whole;
    crossing.front = whole.sign() > 0;
    return crossing;
}

// The foot of the perpendicular when it falls inside, else the best of the three sides.
ClosestPoint closest_on_triangle(const Triangle& triangle, const Point& point) {
    const Point normal = normal_of(triangle);
    const std::optional<Crossing> foot = cross({point, normal}, triangle);
    if (foot) {
        const Point closest = point + normal * foot->t;
        return {closest, squared_length(point - closest)};
    }
    ClosestPoint best = closest_on_segment(triangle.a, triangle.b, point);
    for (const ClosestPoint& other :
         {closest_on_segment(triangle.b, triangle.c, point), closest_on_segment(triangle.c, triangle.a, point)}) {
        if (other.squared_distance < best.squared_distance) best = other;
    }
    return best;
}

}  // namespace espalier::oracle
