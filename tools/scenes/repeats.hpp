// Meshes with the same content: files store copies where their authors copied.
#pragma once

#include <cstdint>
#include <vector>

#include "import/base/imported.hpp"

namespace espalier::tools {

/// Returns, for each mesh, the first mesh with the same positions, triangles and materials, bit for bit and in the same
/// order; its own index if it is the first. Names and places do not count.
std::vector<std::uint32_t> first_with_content(const std::vector<ImportedMesh>& meshes);

}  // namespace espalier::tools
