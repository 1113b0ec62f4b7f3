// Attributes of XML tags, for what an importer leaves out.
#pragma once

#include <string_view>

namespace espalier::tools {

/// Returns the value of an attribute in the text between `<` and `>`; empty without one.
std::string_view tag_attribute(std::string_view tag, std::string_view name);

/// Returns the value of an attribute of the first element of that name in a text; empty without one.
std::string_view xml_attribute(std::string_view text, std::string_view element, std::string_view name);

}  // namespace espalier::tools
