// How far a rounded axis-aligned box is from a triangle of the lattice: zero exactly when they share a point.
#pragma once

#include <runtime/segment_triangle.hpp>

namespace espalier::detail {

/// The box is given by its diagonal, from its lowest to its highest corner. Of the answer `along` means nothing.
SegmentDistance distance_to_box(const UnitSegment& diagonal, const LatticeTriangle& triangle) noexcept;

/// Whether they are at most `radius` apart (lattice steps, 0 or at least 2^-100), exactly; touching counts. `distance`
/// is theirs.
bool is_within_radius_of_box(const UnitSegment& diagonal, const LatticeTriangle& triangle,
                             const SegmentDistance& distance, float radius) noexcept;

}  // namespace espalier::detail
