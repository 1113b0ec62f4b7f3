// From arguments to import options: one reading of --unit, --scale and --up for every verb that reads meshes.
#pragma once

#include "commands.hpp"
#include "import/imported.hpp"

namespace espalier::tools {

/// Throws CommandError (usage) on a scale that is not positive or a unit that does not exist.
ImportOptions import_options(const SourceArguments& arguments);

}  // namespace espalier::tools
