// The nodes of a glTF file: where each stands, which of them the default scene has, and where skins put vertices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "base/placement.hpp"
#include "import/gltf/data/accessors.hpp"

namespace espalier::tools {

struct GltfNodes {
    std::vector<Placement> global;      ///< of every node, from its own space to its scene's
    std::vector<std::size_t> in_scene;  ///< of the default scene, in depth-first order
    std::vector<std::size_t> left_out;  ///< those with a mesh that it has not, ascending
};

/// The default scene is the file's "scene", else the first one, else all nodes. Throws CommandError when nodes are no
/// forest, or a transform is none.
GltfNodes read_gltf_nodes(const GltfObject& root);

/// Returns the words that name a node in messages.
GltfObject gltf_node(const GltfObject& root, std::size_t number);
/// Returns the transform of a translation, then a rotation as x, y, z, w of any length but zero, then a scale.
Placement placement_from(const std::array<double, 3>& translation, const std::array<double, 4>& rotation,
                         const std::array<double, 3>& scale, const GltfObject& described);
/// Returns the transform of a 4x4 matrix by columns. Throws CommandError, with the words `matrix`, when its last row is
/// not 0 0 0 1.
Placement placement_of_matrix(const std::array<double, 16>& columns, const GltfObject& described,
                              std::string_view matrix);

/// Returns the instances' transforms in the node's space: one that changes nothing, for a node without the extension.
std::vector<Placement> gltf_instances(const GltfObject& node, GltfData& data);

/// Returns how many there will be, by what the accessors claim.
std::uint64_t count_gltf_instances(const GltfObject& node, GltfData& data);

/// One placement for each joint of a skin: from the mesh's space to the asset's. The node of the mesh has no part in
/// it, as the specification requires.
std::vector<Placement> joint_placements(GltfData& data, std::size_t skin, const GltfNodes& nodes,
                                        const Placement& asset);

/// JOINTS_0 and WEIGHTS_0, JOINTS_1 and WEIGHTS_1, ... of a primitive.
using GltfInfluences = std::vector<std::pair<GltfAccessor, GltfAccessor>>;

/// Returns the mean of the joints' placements by the weights of a vertex, which need not add up to 1. A vertex without
/// weight stays where the mesh has it: `asset`. Throws CommandError when a weight belongs to no joint.
Placement skinned_placement(const GltfInfluences& influences, std::size_t vertex, const std::vector<Placement>& joints,
                            const Placement& asset, const GltfObject& primitive);

}  // namespace espalier::tools
