// Meshes that are hard on strips, most of them small enough to be one leaf.
#pragma once

#include <vector>

#include "mesh.hpp"

namespace espalier::tests {

/// Triangles around one vertex; a closed fan comes back to where it began.
Mesh make_fan(unsigned count, bool closed);
/// A strip of triangles in a ring; a twisted one is a Moebius band, whose ends meet with the wrong side.
Mesh make_band(unsigned count, bool twisted);
/// Triangles that share no vertex.
Mesh make_disjoint(unsigned count);
/// These and more: both sides of everything, many triangles to an edge, all triangles over few vertices.
std::vector<Mesh> strip_shapes();

}  // namespace espalier::tests
