// Shapes that touch a triangle where they start: how deep they are in it, and whether they leave it.
#pragma once

#include <runtime/sweeps/round_sweep.hpp>

namespace espalier::detail {

// How deep a shape is in a triangle that it touches at the start: the smaller the number, the deeper.

/// The squared distance from the axis, or less than 0 where the two touch.
float gap_at_start(const CapsuleSweep& sweep, const LatticeTriangle& triangle);
float gap_at_start(const BoxSweep& sweep, const LatticeTriangle& triangle);
float gap_at_start(const HullSweep& sweep, const LatticeTriangle& triangle);

// Whether the way leads a shape no deeper into a triangle that it touches at the start. It then gets no deeper until
// the end of the way: a distance is convex along it, and a depth concave (docs/numerics.md, Sweeps).

/// Exactly. False where the axis touches the triangle.
bool leaves_at_start(const CapsuleSweep& sweep, const LatticeTriangle& triangle);
// Along the shortest way out.
bool leaves_at_start(const BoxSweep& sweep, const LatticeTriangle& triangle);
bool leaves_at_start(const HullSweep& sweep, const LatticeTriangle& triangle);

}  // namespace espalier::detail
