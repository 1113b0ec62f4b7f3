// EXT_mesh_gpu_instancing: one mesh at many places of its node.
#pragma once

#include <cstdint>
#include <vector>

#include "base/placement.hpp"
#include "import/gltf/data/accessors.hpp"
#include "import/gltf/data/json.hpp"

namespace espalier::tools {

/// Returns the instances' transforms in the node's space: one that changes nothing, for a node without the extension.
std::vector<Placement> gltf_instances(const GltfObject& node, GltfAccessors& accessors);

/// Returns how many there will be, by what the accessors claim.
std::uint64_t count_gltf_instances(const GltfObject& node, GltfAccessors& accessors);

}  // namespace espalier::tools
