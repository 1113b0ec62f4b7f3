// What the queries ask, answered in exact rational arithmetic from textbook definitions: linear systems for rays,
// projections for distances. Nothing here knows how the runtime does it.
#pragma once

#include <optional>
#include <span>

#include <Eigen/Core>

#include "rational.hpp"

namespace espalier::oracle {

using Point = Eigen::Matrix<Rational, 3, 1>;

struct Triangle {
    Point a;
    Point b;
    Point c;
};

struct Line {
    Point origin;
    Point direction;
};

/// Where a line crosses a triangle: origin + t * direction = a + u * (b - a) + v * (c - a).
struct Crossing {
    Rational t;  // any sign
    Rational u;
    Rational v;
    bool front = false;  // the line runs against the normal (b - a) x (c - a)
};

/// Nothing when the line misses the triangle or lies in its plane. Touching counts.
std::optional<Crossing> cross(const Line& line, const Triangle& triangle);

struct ClosestPoint {
    Point point;
    Rational squared_distance;
};

/// The point of a triangle with area that is closest to `point`.
ClosestPoint closest_on_triangle(const Triangle& triangle, const Point& point);

/// The square of the smallest distance between two convex hulls: of a point, a segment, a triangle or a tetrahedron
/// each, which may be flat. Tries all pairs of their faces, each with the linear system that the closest points of two
/// affine hulls solve.
Rational squared_distance(std::span<const Point> first, std::span<const Point> second);

/// (b - a) x (c - a), not of unit length.
Point normal_of(const Triangle& triangle);

}  // namespace espalier::oracle
