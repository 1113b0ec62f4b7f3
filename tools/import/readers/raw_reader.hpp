// RAW triangles: a text with the coordinates of three corners in each line.
#pragma once

#include <string>

#include "import/base/imported.hpp"

namespace espalier::tools {

/// Appends the file's triangles to `imported`, one mesh for each group. Textures are skipped. A line has nine
/// numbers, or twelve, of which the first three are a colour, and after them the name of a texture or nothing.
/// Throws CommandError (invalid_input) for other lines, with their number.
void import_raw(const std::string& path, const ImportOptions& options, Imported& imported);

}  // namespace espalier::tools
