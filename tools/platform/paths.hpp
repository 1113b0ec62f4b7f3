// Paths as text, which is UTF-8 on every system.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace espalier::tools {

/// Returns the path that the text names. std::filesystem::path(text) depends on settings of the machine on Windows.
/// There, bytes that are no UTF-8 become U+FFFD, so that they name no file.
std::filesystem::path path_of(std::string_view text);
/// Returns the text of a path.
std::string text_of(const std::filesystem::path& path);

}  // namespace espalier::tools
