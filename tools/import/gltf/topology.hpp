// Lists, strips and fans of a glTF primitive to triangles.
#pragma once

#include <cstdint>
#include <optional>

#include "primitive.hpp"

namespace espalier::tools {

inline constexpr std::uint64_t gltf_triangles = 4;

/// Sets the triangles of `primitive` with indices into its positions, or counts its points and lines.
void read_gltf_topology(const GltfObject& object, std::uint64_t mode, const std::optional<GltfAccessor>& indices,
                        GltfPrimitive& primitive);

}  // namespace espalier::tools
