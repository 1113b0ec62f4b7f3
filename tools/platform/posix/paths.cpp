#include "platform/paths.hpp"

namespace espalier::tools {

std::filesystem::path path_of(std::string_view text) { return {text}; }

std::string text_of(const std::filesystem::path& path) { return path.string(); }

}  // namespace espalier::tools
