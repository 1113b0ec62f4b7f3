// Skins of a glTF file: where the joints put each vertex, with the nodes as they stand in the file.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "base/placement.hpp"
#include "import/gltf/data/accessors.hpp"
#include "import/gltf/data/json.hpp"
#include "nodes.hpp"

namespace espalier::tools {

/// One placement for each joint of a skin: from the mesh's space to the asset's. The node of the mesh has no part in
/// it, as the specification requires.
std::vector<Placement> joint_placements(const GltfObject& root, std::size_t skin, const GltfNodes& nodes,
                                        const Placement& asset, GltfAccessors& accessors);

/// JOINTS_0 and WEIGHTS_0, JOINTS_1 and WEIGHTS_1, ... of a primitive.
using GltfInfluences = std::vector<std::pair<GltfAccessor, GltfAccessor>>;

/// Returns the mean of the joints' placements by the weights of a vertex, which need not add up to 1. A vertex without
/// weight stays where the mesh has it: `asset`. Throws CommandError when a weight belongs to no joint.
Placement skinned_placement(const GltfInfluences& influences, std::size_t vertex, const std::vector<Placement>& joints,
                            const Placement& asset, const GltfObject& primitive);

}  // namespace espalier::tools
