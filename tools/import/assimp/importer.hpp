// Files of the formats that assimp reads. Only this folder includes assimp.
#pragma once

#include <string>

#include "import/base/imported.hpp"

namespace espalier::tools {

/// Appends the meshes of one readable file and its record to `imported`. Throws CommandError as import_files does.
void import_with_assimp(const std::string& path, const ImportOptions& options, Imported& imported);

}  // namespace espalier::tools
