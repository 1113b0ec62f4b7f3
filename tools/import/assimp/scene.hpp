// A scene as assimp returns it: nodes, meshes, faces, units.
#pragma once

#include "import/base/imported.hpp"

struct aiScene;

namespace espalier::tools {

/// Appends the meshes of a file's scene to `imported`, and sets the format, unit, axis and warnings of `file`. Throws
/// CommandError (invalid_input) for a scene that contradicts itself.
void read_scene(const aiScene& scene, const ImportOptions& options, ImportedFile& file, Imported& imported);

}  // namespace espalier::tools
