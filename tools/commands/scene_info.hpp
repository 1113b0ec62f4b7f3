// What is inside a scene, for `info`.
#pragma once

#include <cstddef>
#include <span>

#include "base/verb_arguments.hpp"

namespace espalier::tools {

/// Prints it. Throws CommandError for bytes that are no sound scene.
void print_scene_info(const InfoArguments& arguments, std::span<const std::byte> bytes);

}  // namespace espalier::tools
