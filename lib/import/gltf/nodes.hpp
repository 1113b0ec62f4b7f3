// The nodes of a glTF file: where each stands, which of them the default scene has, and where skins put vertices; and
// the primitives of its meshes: their triangles, and the accessors that place their vertices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <espalier/types.hpp>

#include <import/base/importers.hpp>
#include <import/base/node_paths.hpp>
#include <import/base/placement.hpp>
#include <import/gltf/data/accessors.hpp>

namespace espalier::importer {

struct GltfNodes {
    std::vector<Placement> global;  ///< of every node, from its own space to its scene's
    NodePaths paths;
    std::vector<std::uint32_t> path;    ///< of every node its number in `paths`
    std::vector<std::size_t> in_scene;  ///< of the default scene, in depth-first order
    std::vector<std::size_t> left_out;  ///< those with a mesh that it has not, ascending
};

/// The default scene is the file's "scene", else the first one, else all nodes. Throws ImportError when nodes are no
/// forest, or a transform is none.
GltfNodes read_gltf_nodes(const GltfObject& root);

/// Returns what moves all of a scene: the centre that CESIUM_RTC states, so that positions around it fit into float32.
Placement gltf_centre(const GltfObject& root);

/// Returns the words that name a node in messages.
GltfObject gltf_node(const GltfObject& root, std::size_t number);
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
/// weight stays where the mesh has it: `asset`. Throws ImportError when a weight belongs to no joint.
Placement skinned_placement(const GltfInfluences& influences, std::size_t vertex, const std::vector<Placement>& joints,
                            const Placement& asset, const GltfObject& primitive);

struct GltfPrimitive {
    GltfObject object;
    std::vector<TriangleVertices> triangles;  ///< indices into `vertices`; those beyond the source's stay as they are
    std::vector<std::uint32_t> vertices;      ///< elements of `positions` that triangles use, or all; ascending
    std::uint64_t points_and_lines = 0;
    std::uint64_t left_over_corners = 0;  ///< one or two at the end, too few for a triangle
    bool has_positions = false;
    bool differs_from_accessors = false;  ///< Draco packs other numbers of corners or vertices than accessors state
    GltfAccessor positions;
    GltfInfluences influences;                     ///< empty: no skin moves it
    std::optional<std::uint32_t> imported;         ///< the mesh that its places share, once there is one
    bool is_morphed = false;                       ///< morph targets move its vertices
    std::optional<std::vector<Vec3d>> shape = {};  ///< by the weights of the mesh, once it is needed

    /// Returns where `vertices` are in the mesh's space: their positions and the morph targets' parts of them, by the
    /// weights that a node or a mesh states. Targets without one have the weight 0, and are not read.
    [[nodiscard]] std::vector<Vec3d> shape_by(const GltfObject& stated, GltfData& data) const;
};

/// Throws ImportError when it is broken; with `keeps_vertices` (ImportOptions), also (unsupported) when it is packed
/// by Draco, which sorts vertices.
GltfPrimitive read_gltf_primitive(const GltfObject& object, GltfData& data, bool keeps_vertices);

/// Returns how many triangles it will have, by what the accessors claim.
std::uint64_t count_gltf_triangles(const GltfObject& object, GltfData& data);

/// Throws ImportError when the accessor has many elements without stored bytes, where it decides how much is
/// allocated.
void require_stored(const GltfAccessor& accessor, const GltfObject& user);

}  // namespace espalier::importer
