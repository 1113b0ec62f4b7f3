// glTF 2.0 files, .gltf and .glb. docs/baking.md lists what of them is read.
#pragma once

#include <string>

#include "import/base/imported.hpp"

namespace espalier::tools {

/// Appends the meshes of one readable file and its record to `imported`, or returns false for a file that is no
/// glTF. Throws CommandError as import_files does.
bool import_gltf(const std::string& path, const ImportOptions& options, Imported& imported);

}  // namespace espalier::tools
