// The mesh of a place with its placement applied, ready to be baked.
#pragma once

#include "import/base/imported.hpp"

namespace espalier::tools {

/// Returns the mesh with `placement` applied to its vertices, and the file, number and name of the place. Where the
/// placement mirrors, the corners of triangles run the other way, so that their fronts stay outside.
ImportedMesh placed_mesh(const Imported& imported, const ImportedPlace& place, const Placement& placement);

/// Returns the words for the mesh of a place in messages.
std::string words_for_place(const Imported& imported, const ImportedPlace& place);

}  // namespace espalier::tools
