// Whether the baked mesh is closed.
#pragma once

#include "lattice_mesh.hpp"

namespace espalier::baker {

/// Every edge of a kept triangle, taken between lattice points, is used exactly twice, once in each direction, and
/// there is at least one triangle.
[[nodiscard]] bool is_closed(const LatticeMesh& mesh);

}  // namespace espalier::baker
