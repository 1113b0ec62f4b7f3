// A capsule that moves along a line against a triangle. Seen from the sphere at the start of its axis, the triangle is
// swept along the axis backwards: a prism, whose faces the sphere meets or does not.
#pragma once

#include <runtime/kernels/moving_sphere.hpp>

namespace espalier::detail {

/// Triangles are seen from the start of the axis at the start of the way. The axis stays below 2^25, the rest is
/// bounded as in MovingSphere.
struct MovingCapsule {
    MovingSphere sphere;  ///< around the start of the axis
    Integer3 axis;
};

/// Like that of a sphere, for a capsule that does not touch at the start.
SweepStep first_contact(const MovingCapsule& capsule, const IntegerTriangle& triangle, SweepStep most) noexcept;

/// For a first contact at that step: the point of the triangle that is closest to the axis at the tick
/// before, and the direction from there to the closest point of the axis.
SweepContact contact_at(const MovingCapsule& capsule, const IntegerTriangle& triangle, SweepStep step) noexcept;

}  // namespace espalier::detail
