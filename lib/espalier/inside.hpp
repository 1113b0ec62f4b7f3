// Whether a point is inside of a closed surface, and how far it is from it with a sign.
//
// Only a blob whose closed flag is set has an inside (Blob::closed); a blob with copies refuses too. Inside is where
// the winding number is not zero, positive or negative, odd or even: overlapping shells are inside of both, a cavity
// whose triangles face inward is outside, and a surface that was baked inside out has the same inside. A point on the
// surface is inside: touching counts. Triangles need not share their vertices: a corner may lie on another's edge.
//
// Numbers. The point is rounded once onto a grid finer than the asset's lattice (docs/numerics.md). The winding number
// is counted exactly: along an axis, in integers, on a ray that is moved aside by infinitesimally little, alike for all
// triangles (the perturbation of Edelsbrunner and Mücke 1990). The distance and its witness are those of closest_point.
// Arguments. Any bit pattern is safe. A NaN, an infinite point or a negative max_distance is an invalid_argument, O(1).
// Cost. As much as the surface beside the way from the point out of the asset's box, the shortest along an axis.
#pragma once

#include <espalier/blob.hpp>
#include <espalier/nearest.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// ok, not_closed, has_copies or invalid_argument; `inside` is untouched unless ok. A point however far away is
/// outside.
QueryStatus contains(const Blob& blob, Vec3 point, bool& inside) noexcept;

/// The closest point of the surface, its distance negative inside. Where there is none within max_distance (which may
/// be infinite), nearest.triangle is no_triangle and the distance is max_distance, negative inside. Besides the
/// refusals of `contains`, out_of_range for a point more than 2^120 lattice steps away; `nearest` is untouched unless
/// ok.
QueryStatus signed_distance(const Blob& blob, Vec3 point, float max_distance, Nearest& nearest) noexcept;

}  // namespace espalier
