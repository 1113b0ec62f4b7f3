// Lengths with units, as people write them: 0.5mm, 2cm, 1e-3m, 1in; a bare number counts in the asset's own units.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace espalier::tools {

/// Metres in one of the unit: m, km, cm, mm, um, in, ft. Nothing for any other name.
std::optional<double> metres_in(std::string_view unit);

/// The length in units of the asset, of which each is a metre unless the user scaled it. Throws CommandError (usage)
/// that names `option` when the text is no finite length.
double parse_length(const std::string& text, std::string_view option);

}  // namespace espalier::tools
