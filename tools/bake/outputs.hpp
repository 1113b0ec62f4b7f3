// The files that a bake writes, all or none, and the source in the order of the blob.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <espalier/types.hpp>

#include "base/verb_arguments.hpp"
#include "import/base/imported.hpp"

namespace espalier::tools {

/// The bytes of each; those that the arguments do not name may be empty.
struct BakeOutputs {
    std::span<const std::byte> result;
    std::span<const std::byte> remap;
    std::span<const std::byte> reordered;
};

/// Writes the outputs that the arguments name. The depfile lists the files of the import and `poses`. Throws
/// CommandError (file_access).
void write_outputs(const BakeArguments& arguments, const Imported& imported, std::span<const ImportedFile> poses,
                   const BakeOutputs& outputs);

/// Throws CommandError (usage) unless the name ends in .obj or .ply.
void require_writable_mesh(const std::string& path);

/// The bytes of the file: OBJ, or PLY in little-endian binary. Positions are those of the imported meshes one after the
/// other, unrounded; each triangle begins with the corner that the blob's does.
std::vector<std::byte> reordered_mesh(const std::string& path, const Imported& imported,
                                      std::span<const OriginalTriangle> remap);

}  // namespace espalier::tools
