// STL, binary and as text.
#pragma once

#include <string>

#include "import/base/imported.hpp"

namespace espalier::tools {

/// Appends the meshes of one readable file and its record to `imported`: each solid that has triangles is a mesh.
/// Throws CommandError as import_files does.
void import_stl(const std::string& path, const ImportOptions& options, Imported& imported);

}  // namespace espalier::tools
