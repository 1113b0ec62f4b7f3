// Where the coordinates of a blob count from.
#pragma once

#include <span>

#include <espalier/bake.hpp>

namespace espalier::baker {

/// Returns BakeOptions::origin; where there is none, 0 or a place near the middle of the meshes. The latter is a whole
/// multiple of a power of two that no side of the meshes reaches, and so of any step: tiles with an origin each stay on
/// one lattice.
[[nodiscard]] Vec3d choose_origin(std::span<const MeshView> meshes, const BakeOptions& options);

}  // namespace espalier::baker
