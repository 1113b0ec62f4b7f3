// The convex hull of points in space, by quickhull (Barber, Dobkin, Huhdanpaa 1996).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "../volumes/shapes.hpp"

namespace espalier::bench {

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

/// Returns the hull of some of the points: no other point is farther outside than about `flat_share` of the largest
/// side of their box. Thus points that are in one plane but for rounding add no slivers.
///
/// Points are rounded to a lattice of 2^40 steps along that side, on which the side of a plane that a point is on is
/// exact. So the surface is closed and convex, whatever the points are. `flat_share` is 2^-36 or more.
[[nodiscard]] HullMesh convex_hull_of(std::span<const Point> points, double flat_share = float_rounding_share);

}  // namespace espalier::bench
