// Triangles by their distance from a shape with a segment or a box. One walk serves both.
#pragma once

#include <runtime/answers/answer.hpp>
#include <runtime/kernels/triangle_distance.hpp>
#include <runtime/lattice/round_segment.hpp>

namespace espalier::detail {

/// A rounded segment, or a box by its diagonal from the lowest to the highest corner. In lattice steps.
struct DistantShape {
    RoundedSegment segment;
    bool is_box;
    float radius;  ///< 0 or at least 2^-100, may be infinite

    /// The squared distance from a box, at most 16 roundings above the exact one; above the limit any number above it.
    float (*squared_bound)(const DistantShape& shape, const float* low, const float* high, float limit);
    SegmentDistance (*distance_to)(const UnitSegment& segment, const LatticeTriangle& triangle) noexcept;
    bool (*is_within_radius)(const UnitSegment& segment, const LatticeTriangle& triangle,
                             const SegmentDistance& distance, float radius) noexcept;
};

struct FoundPair : Found {
    SegmentDistance distance;
    LatticeTriangle triangle;

    [[nodiscard]] float key() const { return distance.squared; }
    [[nodiscard]] float limit(float before) const { return minimum(key() * distance_slack, before); }
};

/// The triangles within the radius as FoundPair, the nearest first.
void find_nearest(const BlobData& blob, const DistantShape& shape, Answer& answer);

/// With a unit vector across the segment and each axis.
struct DistantSegment : DistantShape {
    float across[3][3];  ///< zeros where the segment is parallel to the axis
};
struct DistantBox : DistantShape {};

/// Sets what follows from the rounded segment or diagonal, and from the kind of shape.
void prepare(DistantSegment& segment) noexcept;
void prepare(DistantBox& box) noexcept;

}  // namespace espalier::detail
