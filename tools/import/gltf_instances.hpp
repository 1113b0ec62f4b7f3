// EXT_mesh_gpu_instancing: one mesh at many places of its node.
#pragma once

#include <vector>

#include "gltf_accessors.hpp"
#include "gltf_json.hpp"
#include "placement.hpp"

namespace espalier::tools {

/// Returns the instances' transforms in the node's space: one that changes nothing, for a node without the extension.
std::vector<Placement> gltf_instances(const GltfObject& node, GltfAccessors& accessors);

}  // namespace espalier::tools
