// Imports and bakes that end the verb when they fail.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/blob.hpp>

#include "base/exit_code.hpp"
#include "base/verb_arguments.hpp"
#include "import/base/imported.hpp"

namespace espalier::tools {

/// Returns options with which the warnings of the import are printed and added to `warnings`, which must live as long.
/// With `json`, a file that ends the process leaves a document on stdout. Throws CommandError (usage) on a scale that
/// is not positive or a unit that does not exist.
ImportOptions import_options(const SourceArguments& arguments, bool json, std::vector<Warning>& warnings);

/// Imports the files and shows how much of it is done, unless `quiet`. Throws as import_files.
Imported import_with_progress(std::span<const std::string> paths, ImportOptions options, bool quiet);

/// Throws CommandError with the baker's reason and the exit code that it stands for, and (internal) when the reader
/// refuses what was baked: what is written has been read by those who will read it.
BakeResult bake_or_throw(const Imported& imported, const BakeOptions& options);

/// The same for meshes that were made of an import, whose files its messages name.
BakeResult bake_or_throw(std::span<const MeshView> meshes, const Imported& imported, const BakeOptions& options);

/// The same for a trial, which never warns of lost_closed (baker::bake_trial).
BakeResult bake_trial_or_throw(const Imported& imported, const BakeOptions& options);

/// Returns the place for scripts.
ErrorDetails details_of(const SourcePlace& place, const Imported& imported);

/// The view of what was just baked; the bytes must outlive it.
Blob opened(const BakeResult& baked);

}  // namespace espalier::tools
