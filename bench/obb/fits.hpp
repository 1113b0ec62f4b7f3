// Ways to fit an oriented box (OBB) to points.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "../volumes/shapes.hpp"
#include "convex_hull.hpp"

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

/// Returns the least box along these axes.
[[nodiscard]] Block box_along(const BoxAxes& axes, std::span<const Point> points);

[[nodiscard]] BoxAxes axes_of_vertices(std::span<const Point> points);
/// Returns the axes of the surface, or of the vertices where that has no area.
[[nodiscard]] BoxAxes axes_of_surface(const HullMesh& hull);

}  // namespace espalier::bench
