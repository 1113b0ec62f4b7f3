// How far the baked surface is from its source.
#pragma once

#include "lattice_mesh.hpp"

namespace espalier::baker {

/// An upper bound on the distance, in world units, rounded up to float32.
///
/// A kept triangle moves no farther than its corners do: each of its points is the same weighted mean of them before and
/// after.
[[nodiscard]] float measure_error(const Source& source, const LatticeMesh& mesh);

}  // namespace espalier::baker
