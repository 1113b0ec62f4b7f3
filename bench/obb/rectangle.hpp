// The least rectangle around points in a plane, by rotating calipers (Freeman, Shapira 1975; Toussaint 1983).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace espalier::bench {

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

}  // namespace espalier::bench
