// The queries by distance in lattice units, once for each instruction set: from a point, and from a segment or a box,
// which one walk serves.
#pragma once

#include <runtime/answers/answer.hpp>
#include <runtime/kernels/triangle_distance.hpp>
#include <runtime/lanes/select.hpp>
#include <runtime/lattice/round_segment.hpp>

namespace espalier::detail {

struct FoundPair : Found {
    SegmentDistance distance;
    LatticeTriangle triangle;

    [[nodiscard]] float key() const { return distance.squared; }
    [[nodiscard]] float limit(float before) const { return minimum(key() * distance_slack, before); }
};

/// A rounded segment, or a box by its diagonal from the lowest to the highest corner. In lattice steps.
struct DistantShape {
    RoundedSegment segment;
    bool is_box;
    float radius;     ///< 0 or at least 2^-100, may be infinite
    float lowest[3];  ///< of the box around it
    float highest[3];
    float across[3][3];  ///< unit vectors across a segment and each axis; zeros where they are parallel, and of a box

    SegmentDistance (*distance_to)(const UnitSegment& segment, const LatticeTriangle& triangle) noexcept;
    bool (*is_within_radius)(const UnitSegment& segment, const LatticeTriangle& triangle,
                             const SegmentDistance& distance, float radius) noexcept;

    /// Hands a triangle to the answer, exactly where it is within the radius and not ruled out. The index is found.
    Visit decide(const LatticeTriangle& triangle, FoundPair& found, Answer& answer) const {
        if (answer.rules_out(0.0f, found.index)) return Visit::next;  // none is nearer
        found.distance = distance_to(segment, triangle);
        if (answer.rules_out(found.distance.squared, found.index) ||
            !is_within_radius(segment, triangle, found.distance, radius))
            return Visit::next;
        found.triangle = triangle;
        return answer.take(found);
    }
};

struct DistantSegment : DistantShape {};
struct DistantBox : DistantShape {};

/// Returns the squared distance beyond which nothing is within the radius, but for what bounds round.
inline float squared_limit_of(const DistantShape& shape) { return shape.radius * shape.radius * distance_slack; }

/// Sets what follows from the rounded segment or diagonal, and from the kind of shape.
ESPALIER_SHARED_CODE inline void prepare(DistantShape& shape, bool is_box) {
    const RoundedSegment& segment = shape.segment;
    shape.is_box = is_box;
    shape.distance_to = distance_to;
    shape.is_within_radius = is_within_radius;
    if (is_box) shape.distance_to = distance_to_box, shape.is_within_radius = is_within_radius_of_box;
    float along[3];
    for (int k = 0; k < 3; ++k) {
        along[k] = is_box ? 0.0f : to_float(segment.to[k] - segment.from[k]);
        shape.lowest[k] = minimum(segment.from_steps[k], segment.to_steps[k]);
        shape.highest[k] = maximum(segment.from_steps[k], segment.to_steps[k]);
    }
    for (int axis = 0; axis < 3; ++axis) {
        const int y = axis == 2 ? 0 : axis + 1, z = axis == 0 ? 2 : axis - 1;
        const float squared = along[y] * along[y] + along[z] * along[z];
        const float inverse = squared > 0.0f ? 1.0f / square_root(squared) : 0.0f;
        shape.across[axis][axis] = 0.0f;
        shape.across[axis][y] = along[z] * inverse;
        shape.across[axis][z] = -along[y] * inverse;
    }
}
inline void prepare(DistantSegment& segment) { prepare(segment, false); }
inline void prepare(DistantBox& box) { prepare(box, true); }

// find_overlaps: triangles of which something is within the radius of a point or a segment, in storage order; true when
// the answer stopped it.
// find_nearest: triangles within the radius as FoundNearest, the nearest first; find_nearest_pair: as FoundPair.
ESPALIER_IN_EACH_SET(bool find_overlaps(const BlobData& blob, const RoundedPoint& sphere, Each& answer,
                                        const WalkAccuracy& accuracy);
                     bool find_overlaps_of_capsule(const BlobData& blob, const DistantShape& capsule, Each& answer,
                                                   const WalkAccuracy& accuracy);
                     void find_nearest(const BlobData& blob, const RoundedPoint& point, Answer& answer,
                                       const WalkAccuracy& accuracy);
                     void find_nearest_pair(const BlobData& blob, const DistantShape& shape, Answer& answer);)

}  // namespace espalier::detail
