// One question of every kind that has no lanes, against the loop over all triangles: what differences.hpp is for rays
// and spheres.
#pragma once

#include <optional>
#include <string>

#include <espalier/blob.hpp>

#include "support/loops/triangle_loop.hpp"
#include "support/queries/shape_maker.hpp"
#include "support/queries/sweep_maker.hpp"

namespace espalier::tests {

/// Volumes, the distances of a segment and of a box, sweeps, whether a point is inside, and a segment and a box in
/// lattice steps: what differs first, and for which shape. The blob has triangles, and no copies of them.
std::optional<std::string> loop_difference(const Blob& blob, const TriangleLoop& loop, ShapeMaker& shapes,
                                           SweepMaker& sweeps);

}  // namespace espalier::tests
