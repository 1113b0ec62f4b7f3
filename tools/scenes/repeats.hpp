// Meshes with the same content: files store copies where their authors copied.
#pragma once

#include <cstdint>
#include <vector>

#include "import/base/imported.hpp"

namespace espalier::tools {

/// Returns, for each mesh, the first mesh with the same positions, triangles and materials, bit for bit and in the same
/// order; its own index if it is the first. Names and places do not count.
std::vector<std::uint32_t> first_with_content(const std::vector<ImportedMesh>& meshes);

/// Returns the mesh with `placement` applied to its vertices, and the file, number and name of the place. Where the
/// placement mirrors, the corners of triangles run the other way, so that their fronts stay outside.
ImportedMesh placed_mesh(const Imported& imported, const ImportedPlace& place, const Placement& placement);

/// Returns the words for the mesh of a place in messages.
std::string words_for_place(const Imported& imported, const ImportedPlace& place);

}  // namespace espalier::tools
