// A bake that ends the verb when it fails.
#pragma once

#include <espalier/bake.hpp>
#include <espalier/blob.hpp>

#include "base/exit_code.hpp"
#include "import/base/imported.hpp"

namespace espalier::tools {

/// Throws CommandError with the baker's reason and the exit code that it stands for, and (internal) when the reader
/// refuses what was baked: what is written has been read by those who will read it.
Baked bake_or_throw(const Imported& imported, const BakeOptions& options);

/// The same for a trial, whose report leaves out BakeReport::lost_closed and bits_that_keep_closed.
Baked bake_trial_or_throw(const Imported& imported, const BakeOptions& options);

/// Returns the place for scripts.
ErrorDetails details_of(const SourcePlace& place, const Imported& imported);

/// The view of what was just baked; the bytes must outlive it.
Blob opened(const Baked& baked);

}  // namespace espalier::tools
