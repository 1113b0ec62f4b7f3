// A frame: the cloth in its pose, the pole and the drops, as a scene that `espalier render` draws.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rain.hpp"

namespace flag {

/// Returns the bytes of a scene. Throws std::runtime_error if Espalier refuses it.
[[nodiscard]] std::vector<std::byte> make_frame(std::span<const std::byte> cloth, std::span<const Drop> drops);

}  // namespace flag
