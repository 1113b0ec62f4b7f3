// Which meshes of an import become instances, and which are merged.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <espalier/blob.hpp>
#include <espalier/import.hpp>

#include "base/verb_arguments.hpp"
#include "variants.hpp"

namespace espalier::tools {

/// Returns, for each mesh, the first mesh with the same positions, triangles and materials, bit for bit and in the same
/// order; its own index if it is the first. Names and places do not count.
std::vector<std::uint32_t> first_with_content(const std::vector<ImportedMesh>& meshes);

/// Returns the mesh with `placement` applied to its vertices, and the file, number and name of the place. Where the
/// placement mirrors, the corners of triangles run the other way, so that their fronts stay outside.
ImportedMesh placed_mesh(const ImportResult& imported, const ImportedPlace& place, const Placement& placement);

/// Returns the words for the mesh of a place in messages.
std::string words_for_place(const ImportResult& imported, const ImportedPlace& place);

struct ScenePlan {
    std::vector<Variant> meshes;        ///< to be baked one by one, in the order of their first places
    std::vector<std::uint32_t> merged;  ///< places, ascending, whose triangles become one blob
};

/// Plans the places of all meshes that have triangles. With Instancing::automatic, meshes are those that are repeated;
/// with Instancing::all, all. What no Transform places within `largest_error` keeps its triangles where they are:
/// merged, or a mesh of its own.
ScenePlan plan_scene(const ImportResult& imported, Instancing instancing, double largest_error);

/// Returns about how many bytes the triangles of a blob take as a part of a larger blob: its own leaves and what it
/// stores for each triangle, with its share of nodes that are four fifths full.
double bytes_as_part(std::span<const std::byte> bytes, const Blob& blob);

/// Returns how many bytes a blob for merged meshes adds to a scene, without the bytes of the meshes.
double bytes_of_merging();

/// Returns how many bytes a mesh with that many instances adds to a scene, with a node for four instances.
double bytes_as_instances(const Blob& blob, std::uint64_t instances);

}  // namespace espalier::tools
