// An axis-aligned box that moves along a line against a triangle: separating axes, each with the time at which it stops
// to separate and that at which it begins again (Eberly 2001), as quotients of integers.
#pragma once

#include <runtime/kernels/moving_sphere.hpp>

namespace espalier::detail {

/// low <= high. Coordinates stay below 2^35, those of triangles below 2^25, their sides too.
struct MovingBox {
    Integer3 low;
    Integer3 high;
    Integer3 displacement;
};

/// The step at which the box first touches the triangle, also one without area; no_contact when it does not, or later
/// than at step `most`.
SweepStep first_contact(const MovingBox& box, const IntegerTriangle& triangle, SweepStep most) noexcept;

/// For a first contact at that step, which is not 0: the middle of what of the triangle lies in the box at the tick
/// before, grown by what it moves in a tick and by roundings; and the axis that is the last to separate, of several the
/// first in the order x, y, z, the triangle's normal, then products of sides and axes.
SweepContact contact_at(const MovingBox& box, const IntegerTriangle& triangle, SweepStep step) noexcept;

}  // namespace espalier::detail
