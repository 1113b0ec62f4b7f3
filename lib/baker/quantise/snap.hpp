// Second stage: vertices move to lattice points, equal ones become one, what lost its area or its uniqueness is
// dropped.
#pragma once

#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// Counts collapsed and duplicate triangles in the findings, from zero: snapping may be tried with several lattices.
[[nodiscard]] LatticeMesh snap_and_weld(const Source& source, const Lattice& lattice, Findings& findings);

}  // namespace espalier::baker
