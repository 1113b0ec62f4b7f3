// The word that a mistyped one was meant to be.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace espalier::tools {

/// Returns the first of the words, in lower case, that are nearest to `typed` in lower case, by letters inserted, left
/// out, replaced or exchanged with the next. Empty if none is within a third of its length.
std::string similar_word(std::string_view typed, std::span<const std::string> words);

}  // namespace espalier::tools
