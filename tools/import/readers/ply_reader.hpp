// PLY, as text and binary in both byte orders.
#pragma once

#include <string>

#include "import/base/imported.hpp"

namespace espalier::tools {

/// Appends the mesh of one readable file and its record to `imported`: the elements vertex, face and tristrips. Throws
/// CommandError as import_files does.
void import_ply(const std::string& path, const ImportOptions& options, Imported& imported);

}  // namespace espalier::tools
