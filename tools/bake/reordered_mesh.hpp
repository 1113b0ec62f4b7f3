// The source in the order of the blob: one mesh whose n-th triangle is the blob's triangle n.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <espalier/types.hpp>

#include "import/base/imported.hpp"

namespace espalier::tools {

/// Throws CommandError (usage) unless the name ends in .obj or .ply.
void require_writable_mesh(const std::string& path);

/// The bytes of the file: OBJ, or PLY in little-endian binary. Positions are those of the imported meshes one after the
/// other, unrounded; each triangle begins with the corner that the blob's does.
std::vector<std::byte> reordered_mesh(const std::string& path, const Imported& imported,
                                      std::span<const OriginalTriangle> remap);

}  // namespace espalier::tools
