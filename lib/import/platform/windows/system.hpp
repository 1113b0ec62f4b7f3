// Text of Windows, which is UTF-16, and its errors as values of errno.
#pragma once

#include <string>
#include <string_view>

namespace espalier::importer {

/// Returns the text in UTF-8; half a pair of surrogates becomes U+FFFD.
std::string utf8_of(std::wstring_view text);
/// Returns the text in UTF-16; bytes that are no UTF-8 become U+FFFD.
std::wstring utf16_of(std::string_view text);

/// Returns the error of the last call of this thread that failed; EIO for those that errno has no value of.
int last_error();

}  // namespace espalier::importer
