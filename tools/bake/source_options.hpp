// From arguments to import options: one reading of --unit, --scale, --up and the limits for every verb that reads
// meshes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/verb_arguments.hpp"
#include "base/exit_code.hpp"
#include "import/base/imported.hpp"

namespace espalier::tools {

/// Returns options with which the warnings of the import are printed and added to `warnings`, which must live as long.
/// With `json`, a file that ends the process leaves a document on stdout. Throws CommandError (usage) on a scale that
/// is not positive or a unit that does not exist.
ImportOptions import_options(const SourceArguments& arguments, bool json, std::vector<Warning>& warnings);

/// Imports the files and shows how much of it is done, unless `quiet`. Throws as import_files.
Imported import_with_progress(std::span<const std::string> paths, ImportOptions options, bool quiet);

}  // namespace espalier::tools
