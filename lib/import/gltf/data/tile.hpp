// Tiles of 3D Tiles 1.0: a header and tables before a binary glTF.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include <import/gltf/data/json.hpp>

namespace espalier::importer {

/// Tests whether bytes begin as a tile, of any kind.
bool is_tile(std::string_view begin);

/// Returns the binary glTF in a b3dm. Throws ImportError: (unsupported) for a tile of another kind and for one that is
/// relative to a centre, (invalid_input) for a broken one.
std::span<const std::byte> glb_of_tile(const std::string& path, std::span<const std::byte> tile);

}  // namespace espalier::importer
