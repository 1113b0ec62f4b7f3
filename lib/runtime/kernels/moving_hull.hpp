// A convex hull of points that moves along a line against a triangle: the kernel of sweeps of oriented boxes and convex
// hulls. Where hull and triangle touch, the way from a point of the hull to a point of the triangle is the part of the
// displacement that is done: the line of the displacement meets the convex hull of all those differences. The kernel
// finds where it does so first, by the simplex method (Dantzig 1951): three differences that surround the line are
// exchanged one by one. Widths: docs/numerics.md, Sweeps.
#pragma once

#include <cstdint>

#include <espalier/shapes.hpp>
#include <runtime/kernels/moving_shapes.hpp>

namespace espalier::detail {

/// Coordinates of displacement and differences stay below 2^30 + 4. Not empty. Points may be repeated, and may lie in
/// one plane, on one line or in the hull of the others.
struct MovingHull {
    Integer3 displacement;
    unsigned point_count;
    std::int32_t point[max_hull_vertices][3];
};

/// A plane behind which a hull stays for a part of its way. One that separated it from a triangle often separates it
/// from the neighbours too.
struct PlaneAhead {
    Integer3 normal{};
    Int128 hull_end = 0;  ///< how far the hull reaches along the normal at the start
    Int128 speed = 0;     ///< how far it moves along the normal on the whole way; 0 where there is no plane yet
};

/// The step at which the hull first touches the triangle, also one without area; no_contact when it does not, or later
/// than at step `most`. Uses the plane that a call for another triangle left, and leaves one: it changes no answer.
SweepStep first_contact(const MovingHull& hull, const IntegerTriangle& triangle, SweepStep most,
                        PlaneAhead& plane) noexcept;
inline SweepStep first_contact(const MovingHull& hull, const IntegerTriangle& triangle, SweepStep most) noexcept {
    PlaneAhead plane;
    return first_contact(hull, triangle, most, plane);
}

/// For a first contact at that step, which is not 0: a point of the triangle that the hull touches then, and the normal
/// of a plane that separates the two until then: the triangle's, if that does. The feature is the smallest part of the
/// triangle with the exact point.
SweepContact contact_at(const MovingHull& hull, const IntegerTriangle& triangle, SweepStep step) noexcept;

}  // namespace espalier::detail
