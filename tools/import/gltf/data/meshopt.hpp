// EXT_meshopt_compression. Only meshopt.cpp includes meshoptimizer.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "json.hpp"

namespace espalier::tools {

/// Returns the bytes that `compressed` holds; `extension` describes them. Throws CommandError when they are
/// damaged, and (unsupported) in a build without meshoptimizer.
std::vector<std::byte> decode_meshopt(const GltfObject& extension, std::span<const std::byte> compressed);

}  // namespace espalier::tools
