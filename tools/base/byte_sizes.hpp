// Amounts of bytes as people write them: 65536, 64K, 1M, 1.5MiB.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace espalier::tools {

/// K is 1024 bytes, M 1024 K, G 1024 M; "KiB" and "KB" mean the same as K, and so on. Fractions are rounded down.
/// Throws CommandError (usage) that names `option` when the text is no such amount, or none above zero.
std::uint64_t parse_byte_size(const std::string& input, std::string_view option);

}  // namespace espalier::tools
