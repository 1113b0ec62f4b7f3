// Mesh files to triangles in the asset's units and axes.
#pragma once

#include <span>
#include <string>

#include <import/base/imported.hpp>

namespace espalier::importer {

/// Reads the files in this order. Throws ImportError: (file_access) when one cannot be read, (invalid_input) when it
/// is broken or no known format, (unsupported) beyond the format's limits.
Imported import_files(std::span<const std::string> paths, const ImportOptions& options);

}  // namespace espalier::importer
