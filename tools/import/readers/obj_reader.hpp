// Wavefront OBJ: the geometry, that is v, f, o, g, and the materials of faces.
#pragma once

#include <string>

#include "import/base/imported.hpp"

namespace espalier::tools {

/// Appends the meshes of one readable file and its record to `imported`. A mesh is what has the same `o` and `g` names;
/// meshes are numbered by their first face, and triangles by the order of their faces. With
/// ImportOptions::keep_vertices all is one mesh, named if the file names one. Throws CommandError as import_files does.
void import_obj(const std::string& path, const ImportOptions& options, Imported& imported);

}  // namespace espalier::tools
