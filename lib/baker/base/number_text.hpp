// Numbers for messages, in the shorter of fixed and scientific notation.
#pragma once

#include <optional>
#include <string>

#include <espalier/types.hpp>

namespace espalier::baker {

/// Returns nine significant digits, so that a float32 reads back as itself; NaN, infinity or -infinity.
[[nodiscard]] std::string number_text(double value);

/// Returns six significant digits.
[[nodiscard]] std::string short_number_text(double value);

/// Returns the first coordinate that is not finite, as in "y = NaN", or nothing.
[[nodiscard]] std::optional<std::string> find_not_finite(const Vec3& point);
[[nodiscard]] std::optional<std::string> find_not_finite(const Vec3d& point);

}  // namespace espalier::baker
