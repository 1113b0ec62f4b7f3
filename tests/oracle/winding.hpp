// Winding numbers around points, of any triangles: in two ways that share nothing with each other, nor with the
// library. Coordinates are whole numbers below 2^31, in a unit of the caller's.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace espalier::oracle {

using WholePoint = std::array<std::int64_t, 3>;

struct WholeTriangle {
    std::array<WholePoint, 3> corner;
};

/// Tests exactly whether the point lies on one of the triangles, all of which have an area.
bool is_on_surface(std::span<const WholeTriangle> triangles, const WholePoint& point);

/// Counts exactly how often a ray in this direction (coordinates below 2^21) leaves through the triangles, less how
/// often it enters. The point is not on the surface. Nothing if the ray's line meets an edge or lies in a plane.
std::optional<std::int64_t> crossings(std::span<const WholeTriangle> triangles, const WholePoint& point,
                                      const WholePoint& direction);

/// Returns the solid angle of all triangles seen from the point, as a part of the full one, in floating point. It is
/// whole, for each point that is not on the surface, if and only if the boundary of the triangles cancels.
double winding(std::span<const WholeTriangle> triangles, const WholePoint& point);

}  // namespace espalier::oracle
