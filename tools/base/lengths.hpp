// Lengths and amounts of bytes as people write them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace espalier::tools {

/// Metres in one of the unit: m, km, cm, mm, um, in, ft. Nothing for any other name.
std::optional<double> metres_in(std::string_view unit);

/// The length in units of the asset, of which each is a metre unless the user scaled it. Throws CommandError (usage)
/// that names `option` when the text is no finite length.
double parse_length(const std::string& text, std::string_view option);

/// K is 1024 bytes, M 1024 K, G 1024 M; "KiB" and "KB" mean the same as K, and so on. Fractions are rounded down.
/// Throws CommandError (usage) that names `option` when the text is no such amount, or none above zero.
std::uint64_t parse_byte_size(const std::string& input, std::string_view option);

}  // namespace espalier::tools
