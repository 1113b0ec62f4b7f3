// Defects of files that assimp hides: it reads on, and what it returns has lost or invented triangles.
#pragma once

#include "import/base/imported.hpp"

namespace espalier::tools {

/// Tests the text or the chunks of a file that assimp has read, by its format. Appends a warning for one that lacks its
/// end. Throws CommandError (invalid_input) for an index beyond the vertices, (unsupported) for lists of polygons of
/// which assimp keeps one.
void find_hidden_defects(ImportedFile& file);

}  // namespace espalier::tools
