// The bytes of a scene, with their meaning; those of its meshes as in a blob.
#pragma once

#include <cstddef>
#include <span>

#include <espalier/scene.hpp>

#include "byte_listing.hpp"

namespace espalier::tools {

/// Lists the header of a scene, as far as there are bytes.
void list_scene_header(std::span<const std::byte> bytes, ByteListing& listing);

/// Lists every byte of a scene, which was opened on `bytes`.
void list_scene(std::span<const std::byte> bytes, const BakedScene& scene, ByteListing& listing);

}  // namespace espalier::tools
