// Numbers for messages, in the shorter of fixed and scientific notation.
#pragma once

#include <string>

namespace espalier::baker {

/// Returns nine significant digits, so that a float32 reads back as itself.
[[nodiscard]] std::string number_text(double value);

/// Returns six significant digits.
[[nodiscard]] std::string short_number_text(double value);

}  // namespace espalier::baker
