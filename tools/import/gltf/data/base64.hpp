// Bytes in text, as the buffers of .gltf files have them.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace espalier::tools {

/// Returns nothing unless the whole text is base64 of RFC 4648; '=' at its end may be missing.
std::optional<std::vector<std::byte>> decode_base64(std::string_view text);

}  // namespace espalier::tools
