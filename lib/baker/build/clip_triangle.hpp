// Parts of triangles: the box around what of a triangle lies on one side of a plane.
#pragma once

#include <baker/base/lane_box.hpp>
#include <baker/build/sah_split.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

struct ClippedParts {
    LaneBox left;   ///< what lies at or below the plane; empty where nothing does
    LaneBox right;  ///< what lies at or above it
};

/// A box without a point: of no use but to be recognised.
[[nodiscard]] inline bool is_empty(const LaneBox& box) {
    return box.lo[0] > box.hi[0] || box.lo[1] > box.hi[1] || box.lo[2] > box.hi[2];
}

/// Cuts a reference at the lattice plane where coordinate `axis` is `plane`.
///
/// Every point of the triangle that lies in the reference's box lies in one of the two parts. A point at or below the
/// plane is one of the polygon that the plane leaves of the triangle, whose corners are corners of the triangle and
/// points where its sides cross the plane; both go into the left box, the crossings rounded down for its low corner and
/// up for its high one, in integers, so that the box holds the whole polygon. What is then taken away lies outside of
/// the reference's box. The same holds above. Hence, by induction over the cuts, the boxes of all references of a
/// triangle together hold all of its points: whichever point a ray hits, one of the leaves that hold it is visited.
[[nodiscard]] ClippedParts clip(const LatticeMesh& mesh, const Reference& reference, unsigned axis, float plane);

}  // namespace espalier::baker
