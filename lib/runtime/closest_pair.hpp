// The triangle closest to a shape. One walk serves all shapes.
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>
#include <espalier/function_ref.hpp>
#include <runtime/lattice_segment.hpp>
#include <runtime/segment_triangle.hpp>

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

struct FoundPair {
    SegmentDistance distance;
    std::uint32_t index;
    LatticeTriangle triangle;
};

/// The closest triangle within the radius, of equal ones the one with the lowest storage index. False, and `best`
/// means nothing, when there is none.
bool closest_pair(const BlobData& blob, const DistantShape& shape, FoundPair& best) noexcept;

/// The triangles within the radius from storage index `first` on, in storage order. False when the visitor stopped it.
bool visit_triangles_within(const BlobData& blob, const DistantShape& shape, std::uint32_t first,
                            FunctionRef<Visit(Triangle)> visit);

/// A segment, with a unit vector across it and each axis.
struct DistantSegment : DistantShape {
    LatticeSegment segment;
    float across[3][3];  ///< zeros where the segment is parallel to the axis
};

/// A box, by its diagonal from the lowest to the highest corner.
struct DistantBox : DistantShape {
    LatticeSegment diagonal;
};

/// The rest of a shape whose segment or diagonal is set.
void prepare(DistantSegment& segment) noexcept;
void prepare(DistantBox& box) noexcept;

}  // namespace espalier::detail
