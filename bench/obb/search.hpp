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
#pragma once

#include "fits.hpp"

namespace espalier::bench {

/// What is least.
enum class BoxMeasure : std::uint8_t { volume, area };

[[nodiscard]] BoxAxes flush_axes(const HullMesh& hull, BoxMeasure measure);
[[nodiscard]] BoxAxes search_axes(const HullMesh& hull, BoxMeasure measure);

}  // namespace espalier::bench
