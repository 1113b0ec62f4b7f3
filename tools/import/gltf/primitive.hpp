// A primitive of a glTF mesh: its triangles, and the accessors that place their vertices.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <espalier/types.hpp>

#include "import/base/imported.hpp"
#include "import/gltf/data/accessors.hpp"
#include "nodes.hpp"

namespace espalier::tools {

struct GltfPrimitive {
    GltfObject object;
    std::vector<TriangleVertices> triangles;  ///< indices into `vertices`; those beyond the source's stay as they are
    std::vector<std::uint32_t> vertices;      ///< elements of `positions` that triangles use, or all; ascending
    std::uint64_t points_and_lines = 0;
    std::uint64_t left_over_corners = 0;  ///< one or two at the end, too few for a triangle
    bool has_positions = false;
    bool differs_from_accessors = false;  ///< Draco packs other numbers of corners or vertices than accessors state
    GltfAccessor positions;
    GltfInfluences influences;              ///< empty: no skin moves it
    std::optional<std::uint32_t> imported;  ///< the mesh that its places share, once there is one

    /// Returns where a vertex is in the mesh's space: its position and the morph targets' parts of it.
    [[nodiscard]] std::array<double, 3> position(std::uint32_t vertex, const std::vector<double>& weights,
                                                 const std::vector<GltfAccessor>& displacements) const;
    /// Tests whether morph targets move its vertices.
    [[nodiscard]] bool is_morphed() const;
    /// Returns one accessor for each weight. Those of weight 0 are not read, and have no elements.
    [[nodiscard]] std::vector<GltfAccessor> displacements(const std::vector<double>& weights, GltfData& data) const;
};

/// Throws CommandError when it is broken; with `keeps_vertices` (ImportOptions), also (unsupported) when it is packed
/// by Draco, which sorts vertices.
GltfPrimitive read_gltf_primitive(const GltfObject& object, GltfData& data, bool keeps_vertices);

/// Returns how many triangles it will have, by what the accessors claim.
std::uint64_t count_gltf_triangles(const GltfObject& object, GltfData& data);

/// The most elements that an accessor without stored bytes may have where it decides how much is allocated.
inline constexpr std::size_t most_elements_without_bytes = std::size_t{1} << 20;
/// Throws CommandError when the accessor has more.
void require_stored(const GltfAccessor& accessor, const GltfObject& user);

inline constexpr std::uint64_t gltf_triangles = 4;

/// Sets the triangles of `primitive` with indices into its positions, or counts its points and lines.
void read_gltf_topology(const GltfObject& object, std::uint64_t mode, const std::optional<GltfAccessor>& indices,
                        GltfPrimitive& primitive);

}  // namespace espalier::tools
