// From arguments to import options: one reading of --unit, --scale, --up and the limits for every verb that reads
// meshes.
#pragma once

#include "commands.hpp"
#include "import/imported.hpp"

namespace espalier::tools {

/// With `json`, a file that ends the process leaves a document on stdout. Throws CommandError (usage) on a scale that
/// is not positive or a unit that does not exist.
ImportOptions import_options(const SourceArguments& arguments, bool json);

}  // namespace espalier::tools
