// How far a rounded segment is from a triangle of the lattice: zero exactly when they share a point. Otherwise the
// distance is reached from an end of the segment, or between its inside and a side or corner of the triangle; all of
// them are quotients of integers (docs/numerics.md). Segments of length zero and triangles without area are no special
// cases.
#pragma once

#include <runtime/kernels/point_triangle.hpp>
#include <runtime/lattice/round_segment.hpp>
#include <runtime/lattice/triangle.hpp>

namespace espalier::detail {

/// A pair of closest points, and how far they are apart in lattice steps.
struct SegmentDistance {
    float squared = 0.0f;  ///< within 6 ulp; 0 exactly when segment and triangle share a point
    float along = 0.0f;    ///< on the segment: 0 at `from`, 1 at `to`
    float u = 0.0f;        ///< on the triangle: weights of corners b and c
    float v = 0.0f;
    Feature feature = Feature::face;  ///< the part of the triangle on which the point of this pair lies, exactly
};

/// Reached on a side of the triangle, 0 from a to b, 1 from b to c, 2 from c to a; `share` is how far along it.
inline SegmentDistance at_side(float squared, float along, int side, float share, Feature feature) {
    const auto [u, v] = weights_on_side(side, share);
    return {squared, along, u, v, feature};
}
inline Feature edge_of(int side) { return static_cast<Feature>(static_cast<int>(Feature::edge_ab) + side); }
inline Feature vertex_of(int corner) { return static_cast<Feature>(static_cast<int>(Feature::vertex_a) + corner); }

SegmentDistance distance_to(const UnitSegment& segment, const LatticeTriangle& triangle) noexcept;

/// Whether they are at most `radius` apart (lattice steps, 0 or at least 2^-100), exactly; touching counts. `distance`
/// is theirs.
bool is_within_radius(const UnitSegment& segment, const LatticeTriangle& triangle, const SegmentDistance& distance,
                      float radius) noexcept;

}  // namespace espalier::detail
