// Ways to fit an oriented box (OBB) to points.
#pragma once

#include "../study/shapes.hpp"
#include "hull.hpp"

namespace espalier::bench {

enum class BoxFit : std::uint8_t {
    aligned,   ///< along the axes: what the others are compared with
    vertices,  ///< along the eigenvectors of the vertices' covariance
    hull,      ///< along those of the covariance of the convex hull's surface (Gottschalk, Lin, Manocha 1996)
    flush,     ///< the least of those with a side on a face of the convex hull
    search,    ///< the same and others, improved by small turns: see search.hpp
};
inline constexpr std::array all_box_fits = {BoxFit::aligned, BoxFit::vertices, BoxFit::hull, BoxFit::flush,
                                            BoxFit::search};
/// Returns the name in rows.
[[nodiscard]] std::string_view name_of(BoxFit fit);

/// Perpendicular, of length 1.
using BoxAxes = std::array<Point, 3>;

/// Fits a box to one point or more. It contains all of them but for what double rounds off.
[[nodiscard]] Block fit_box(BoxFit fit, std::span<const Point> points);

[[nodiscard]] BoxAxes axes_of_vertices(std::span<const Point> points);
/// Returns the axes of the surface, or of the vertices where that has no area.
[[nodiscard]] BoxAxes axes_of_surface(const HullMesh& hull);

// The search for the axes of the least box around a convex hull.
//
// A box of least volume has two neighbouring sides that are each flush with an edge of the hull (O'Rourke 1985), from
// which his algorithm finds it in O(n^3). The search here is no proof of the minimum, only:
// - the exact least of all boxes with a side on a face of the hull: the other axes are those of the least rectangle
//   around the hull's projection (Freeman, Shapira 1975), O(n^2 log n). The minimum may be smaller: around a regular
//   tetrahedron by half;
// - of several first boxes, the best that small turns lead to: a pattern search with ever smaller turns about its axes,
//   then the least rectangle in the plane across each axis, as long as that helps. This is the local part of HYBBRID
//   (Chang, Gorissen, Melchior 2011), with fixed first boxes in the place of a population that evolves.

[[nodiscard]] BoxAxes flush_axes(const HullMesh& hull);
[[nodiscard]] BoxAxes search_axes(const HullMesh& hull);

}  // namespace espalier::bench
