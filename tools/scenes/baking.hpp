// The bake of a scene: its meshes one by one, then their instances.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <espalier/bake.hpp>

#include "base/verb_arguments.hpp"
#include "import/base/imported.hpp"

namespace espalier::tools {

/// A mesh of a scene, for the report.
struct SceneMesh {
    std::string name;  ///< words for its first place; empty for the merged mesh
    std::uint64_t instances = 0;
    std::uint64_t places = 0;  ///< of the import: more than one for the merged mesh
    BakeReport baked;
};

struct SceneBake {
    std::vector<std::byte> bytes;
    SceneReport report;
    /// Sums over all instances, for what one blob of them would report; the lattice is that of no mesh.
    BakeReport total;
    std::vector<SceneMesh> meshes;
    /// The place of each instance, by Instance::source; none for the merged mesh, which is the first if there is one.
    std::vector<std::optional<std::uint32_t>> places;
    double placing_error = 0.0;  ///< the largest distance between an instance and the place that it stands for
    double max_error = 0.0;      ///< the largest sum of that and of the error of the mesh, in world units
};

/// Bakes an import with ImportOptions::keep_places. A tolerance holds in world units, the error of placing included.
/// Throws CommandError as bake_or_throw does, and (unsupported) beyond what a scene can hold.
SceneBake bake_scene_or_throw(const Imported& imported, Instancing instancing, const BakeOptions& options);

/// Instance::user of the merged mesh. That of other instances is the number of the mesh at their place, counted through
/// all files.
inline constexpr std::uint32_t no_user = 0xFFFFFFFF;

}  // namespace espalier::tools
