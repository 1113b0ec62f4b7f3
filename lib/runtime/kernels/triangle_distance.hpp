// How far two triangles of a common integer grid are apart: zero exactly when they share a point. Where they share none
// the distance is reached from one of six corners, or between the insides of two of nine pairs of sides.
#pragma once

#include <runtime/kernels/segment_triangle.hpp>
#include <runtime/lattice/triangle.hpp>

namespace espalier::detail {

/// Between a and b, in steps of the grid.
struct TriangleDistance {
    float squared;  ///< within 6 ulp; 0 exactly when they share a point
    Weights on_a;   ///< at the closest point of each
    Weights on_b;
};

/// All zeros when they share a point. Coordinates are below 2^25.
void find_distance_if_apart(const LatticeTriangle& a, const LatticeTriangle& b, TriangleDistance& distance) noexcept;

/// Returns the distance of two triangles, and where they meet if they share a point.
TriangleDistance distance_between(const LatticeTriangle& a, const LatticeTriangle& b) noexcept;

/// Whether they are at most `radius` apart (steps of the grid, 0 or at least 2^-100), exactly; touching counts.
/// `distance` is theirs.
bool is_within_radius(const LatticeTriangle& a, const LatticeTriangle& b, const TriangleDistance& distance,
                      float radius) noexcept;

// How far a rounded axis-aligned box is from a triangle of the lattice: zero exactly when they share a point.

/// Returns the diagonal of a box that leads straightest through the triangle's plane, from the corner farthest behind
/// it to the one farthest in front.
UnitSegment diagonal_across(const UnitSegment& diagonal, const LatticeTriangle& triangle) noexcept;

/// The box is given by its diagonal, from its lowest to its highest corner. Of the answer `along` means nothing.
SegmentDistance distance_to_box(const UnitSegment& diagonal, const LatticeTriangle& triangle) noexcept;

/// Whether they are at most `radius` apart (lattice steps, 0 or at least 2^-100), exactly; touching counts. `distance`
/// is theirs.
bool is_within_radius_of_box(const UnitSegment& diagonal, const LatticeTriangle& triangle,
                             const SegmentDistance& distance, float radius) noexcept;

}  // namespace espalier::detail
