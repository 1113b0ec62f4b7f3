// The shortest way out of a triangle for a shape that touches it: along one of the directions that can separate the
// two. Overlaps are exact, their lengths are floats.
#pragma once

#include <espalier/types.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/lattice/round_segment.hpp>
#include <runtime/lattice/triangle.hpp>

namespace espalier::detail {

/// A direction in which the shape can leave the triangle, and how far it has to go.
struct WayOut {
    Vec3 normal;
    float depth = 0.0f;
    WideVector axis = {0, 0, 0};  ///< along the normal, exactly; zero where no direction was tried
};

/// Returns the triangle's normal, for lattice steps.
inline WideVector wide_normal_of(const LatticeTriangle& triangle) {
    return wide_cross(side_from(triangle, 0), side_from(triangle, 1));
}

/// Tries both senses of a direction, unless it is zero. `of_shape` is what the shape takes up along it; the corners are
/// counted from the same point.
void try_way(const WideVector& axis, const Span<Int128>& of_shape, const Integer3* corner, WayOut& best) noexcept;

/// Returns the shortest way out of the triangle for a segment that shares a point with it: across the face, or across
/// the segment and a side. Without a direction, of a segment and a triangle on one line, depth and normal are zero.
WayOut way_out(const UnitSegment& segment, const LatticeTriangle& triangle) noexcept;

}  // namespace espalier::detail
