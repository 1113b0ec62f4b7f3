#include "platform/paths.hpp"

#include "text.hpp"

namespace espalier::tools {

std::filesystem::path path_of(std::string_view text) { return {utf16_of(text)}; }

std::string text_of(const std::filesystem::path& path) { return utf8_of(path.native()); }

}  // namespace espalier::tools
