// Defects of files that assimp hides: it reads on, and what it returns has lost or invented triangles.
#pragma once

#include <string_view>

#include "import/base/imported.hpp"

namespace espalier::tools {

/// Tests the text or the chunks of a file that assimp has read, by its format. Appends a warning for one that lacks its
/// end. Throws CommandError (invalid_input) for an index beyond the vertices, (unsupported) for lists of polygons of
/// which assimp keeps one.
void find_hidden_defects(ImportedFile& file);

/// Returns the value of an attribute in the text between `<` and `>`; empty without one.
std::string_view tag_attribute(std::string_view tag, std::string_view name);

/// Returns the value of an attribute of the first element of that name in a text; empty without one.
std::string_view xml_attribute(std::string_view text, std::string_view element, std::string_view name);

}  // namespace espalier::tools
