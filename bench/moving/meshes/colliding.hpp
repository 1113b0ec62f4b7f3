// Meshes that tumble: pairs whose triangles touch.
#pragma once

#include "../../../tests/support/meshes/mesh.hpp"
#include "../broad_phase.hpp"

namespace espalier::bench {

/// Scales and moves the mesh so that it fills a unit cube around the origin, runs the scenario with it in place of a
/// cube, and prints rows and a table. Peers find pairs with the mesh itself, which the library has rounded to a
/// lattice: pairs that only just touch may differ.
void print_bunnies(const Scenario& scenario, tests::Mesh mesh);

BroadPhaseMakers espalier_colliding_makers();
BroadPhaseMakers fcl_colliding_makers(const tests::Mesh& mesh);

}  // namespace espalier::bench
