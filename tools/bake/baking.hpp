// A bake that ends the verb when it fails.
#pragma once

#include <span>

#include <espalier/bake.hpp>
#include <espalier/blob.hpp>

#include "base/exit_code.hpp"
#include "import/base/imported.hpp"

namespace espalier::tools {

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
