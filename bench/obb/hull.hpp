// On which side of a plane a point of a lattice is: exact.
#pragma once

#include "../study/shapes.hpp"

namespace espalier::bench {

/// Lattice points have whole coordinates from 0 to this, in double.
inline constexpr double lattice_steps = 0x1p40;

/// Returns a number with the sign of the determinant of b - a, c - a and p - a: positive where p is on the side from
/// which a, b, c are counterclockwise, 0 where p is in their plane.
[[nodiscard]] double side_of(const Point& a, const Point& b, const Point& c, const Point& p);

// The least rectangle around points in a plane, by rotating calipers (Freeman, Shapira 1975; Toussaint 1983).

struct PlanePoint {
    double x, y;
    std::uint32_t number = 0;  ///< of the point in space that it comes from
};

/// Reduces points to the corners of their convex hull, counterclockwise (Andrew 1979).
void reduce_to_polygon(std::vector<PlanePoint>& points);

struct Rectangle {
    std::array<double, 2> direction{};  ///< of one side, of length 1
    double along = 0.0;                 ///< the length of that side
    double across = 0.0;                ///< the length of the other one
};

/// Replaces `rectangles` by those around a convex polygon that have a side on one of its edges, for each edge. One of
/// them has the least area.
void find_rectangles(std::span<const PlanePoint> polygon, std::vector<Rectangle>& rectangles);

// The convex hull of points in space, by quickhull (Barber, Dobkin, Huhdanpaa 1996).

/// What float rounds off, as a share of the largest side of the points' box.
inline constexpr double float_rounding_share = 0x1p-23;

struct HullMesh {
    using Triangle = std::array<std::uint32_t, 3>;

    /// 3; 2: all points are in one plane; 1: on one line; 0: at one place.
    unsigned dimension = 0;
    std::vector<Point> vertices;
    /// Numbers of vertices, counterclockwise from outside. In a plane, they cover the polygon once; on a line or at one
    /// place there are none.
    std::vector<Triangle> triangles;
};

/// Returns the hull of some of the points: no other point is farther outside than about what float rounds off. Thus
/// points that are in one plane but for rounding add no slivers.
///
/// Points are rounded to a lattice of 2^40 steps along that side, on which the side of a plane that a point is on is
/// exact. So the surface is closed and convex, whatever the points are.
[[nodiscard]] HullMesh convex_hull_of(std::span<const Point> points);

}  // namespace espalier::bench
