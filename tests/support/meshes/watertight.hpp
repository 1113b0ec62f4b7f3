// Closed meshes that are hard to keep closed on a lattice: slivers of all kinds, thin slabs, shells in shells.
#pragma once

#include <vector>

#include "mesh.hpp"
#include "support/base/random.hpp"

namespace espalier::tests {

/// The smallest example: one of its triangles becomes three points on a line at 16 bits.
Mesh make_sliver_pyramid();

/// Closed by construction: each edge runs as often one way as the other. Up to some hundred triangles, of which many
/// are slivers; no corner of one is nearer to another than float32 keeps apart, and none is without area.
Mesh make_watertight(Random& random);

/// The triangle at `index` becomes three around a corner of its own, and its edge from corner 0 to 1 gets a sliver:
/// the corner lies `off` away from the point at `share` of the edge. The mesh stays closed.
void add_sliver(Mesh& mesh, std::size_t index, float share, Vec3 off);

}  // namespace espalier::tests
