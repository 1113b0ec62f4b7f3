// Pieces of a surface that meet along their borders, but were rounded apart.
#pragma once

#include <cstdint>
#include <vector>

#include <espalier/scene.hpp>

#include "base/exit_code.hpp"
#include "baking.hpp"
#include "import/base/imported.hpp"

namespace espalier::tools {

/// Returns how many places of an import share an edge of their borders with another place, from which the bake may have
/// moved them: the two are neither in one blob nor both on the scene's common lattice. A border edge is one of a single
/// triangle, on a side of the mesh's box.
std::uint64_t places_apart(const Imported& imported, const SceneBake& baked, const BakedScene& scene);

/// Returns a warning if there are such places.
std::vector<Warning> border_warnings(const Imported& imported, const SceneBake& baked, const BakedScene& scene);

}  // namespace espalier::tools
