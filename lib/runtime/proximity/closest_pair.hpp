// Triangles by their distance from a shape with a segment or a box. One walk serves both.
#pragma once

#include <cstdint>

#include <runtime/answers/answer.hpp>
#include <runtime/kernels/triangle_distance.hpp>
#include <runtime/lattice/round_segment.hpp>

namespace espalier::detail {

/// The base of each rounded shape: in lattice steps, its distances from boxes and triangles.
struct DistantShape {
    /// Of a box, at most 16 roundings above the square of the distance.
    float (*squared_bound)(const DistantShape& shape, const float* low, const float* high);
    /// The same of a triangle, by its plane.
    float (*squared_plane_bound)(const DistantShape& shape, const LatticeTriangle& triangle);
    SegmentDistance (*distance_to)(const DistantShape& shape, const LatticeTriangle& triangle);
    bool (*is_within_radius)(const DistantShape& shape, const LatticeTriangle& triangle,
                             const SegmentDistance& distance, float radius);
    float radius;  ///< 0 or at least 2^-100, may be infinite
};

struct FoundPair : Found {
    SegmentDistance distance;
    LatticeTriangle triangle;

    [[nodiscard]] float key() const { return distance.squared; }
    [[nodiscard]] float limit(float before) const { return minimum(key() * distance_slack, before); }
};

/// The triangles within the radius as FoundPair, the nearest first.
void find_nearest(const BlobData& blob, const DistantShape& shape, Answer& answer);

/// A segment, with a unit vector across it and each axis.
struct DistantSegment : DistantShape {
    RoundedSegment segment;
    float across[3][3];  ///< zeros where the segment is parallel to the axis
};

/// A box, by its diagonal from the lowest to the highest corner.
struct DistantBox : DistantShape {
    RoundedSegment diagonal;
};

/// The rest of a shape whose segment or diagonal is set.
void prepare(DistantSegment& segment) noexcept;
void prepare(DistantBox& box) noexcept;

}  // namespace espalier::detail
