// Text of Windows, which is UTF-16, and UTF-8.
#pragma once

#include <string>
#include <string_view>

namespace espalier::tools {

/// Returns the text in UTF-8; half a pair of surrogates becomes U+FFFD.
std::string utf8_of(std::wstring_view text);

}  // namespace espalier::tools
