// Which meshes of an import become instances, and which are merged.
#pragma once

#include <cstdint>
#include <vector>

#include "base/verb_arguments.hpp"
#include "import/base/imported.hpp"
#include "variants.hpp"

namespace espalier::tools {

struct ScenePlan {
    std::vector<Variant> meshes;        ///< to be baked one by one, in the order of their first places
    std::vector<std::uint32_t> merged;  ///< places, ascending, whose triangles become one blob
};

/// Plans the places of all meshes that have triangles. With Instancing::automatic, meshes are those that are repeated;
/// with Instancing::all, all. What no Transform places within `largest_error` keeps its triangles where they are:
/// merged, or a mesh of its own.
ScenePlan plan_scene(const Imported& imported, Instancing instancing, double largest_error);

}  // namespace espalier::tools
