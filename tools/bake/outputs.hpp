// The files that a bake writes, all or none.
#pragma once

#include <cstddef>
#include <span>

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

}  // namespace espalier::tools
