// Numbers for messages.
#pragma once

#include <string>

namespace espalier::baker {

/// Shortest of fixed and scientific, nine significant digits.
[[nodiscard]] std::string number_text(double value);

}  // namespace espalier::baker
