// The bake of a scene, its meshes one by one and then their instances; its report, as lines for people and as JSON for
// scripts; and pieces of a surface that meet along their borders, but were rounded apart.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <espalier/import.hpp>
#include <espalier/scenes/bake.hpp>

#include "base/exit_code.hpp"
#include "base/verb_arguments.hpp"
#include "report/diagnostics.hpp"
#include "report/json.hpp"

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

/// Moves the places of an import to the origin of its scene, which it returns: BakeOptions::origin, or one that is
/// chosen where float32 rounds places at a mesh by more than a quarter of its step. Near the middle then, else 0.
Vec3d move_to_origin(ImportResult& imported, const BakeOptions& options);

/// Bakes an import with ImportOptions::keep_places, whose places count from BakeOptions::origin. A tolerance holds in
/// world units, the error of placing included. Throws CommandError as bake_or_throw does, and (unsupported) beyond what
/// a scene can hold.
SceneBake bake_scene_or_throw(const ImportResult& imported, Instancing instancing, const BakeOptions& options);

/// Instance::user of the merged mesh. That of other instances is the number of the mesh at their place, counted through
/// all files.
inline constexpr std::uint32_t no_user = 0xFFFFFFFF;

/// What was dropped, and the result in numbers.
void say_scene(const Console& console, const SceneBake& baked, const BakedScene& scene);

Json scene_json(const BakeArguments& arguments, const ImportResult& imported, const SceneBake& baked,
                const BakedScene& scene, std::span<const Warning> warnings);

/// Adds up the reports of the meshes of a scene: triangles and findings count once for each instance. Of the tree only
/// the triangles are added, up to the most that their type holds.
class ReportTotal {
public:
    /// `name` is that of the mesh; empty for the merged mesh.
    void add(const BakeReport& report, const std::string& name, std::uint64_t instances);
    /// Returns the sums, with one warning of each kind: that of the first mesh, and how many meshes have one.
    [[nodiscard]] BakeReport report() const;

private:
    struct CountedWarning {
        BakeWarning first;
        std::uint64_t meshes;
    };
    BakeReport sum_;
    std::vector<CountedWarning> warnings_;
};

/// Returns a warning if places of an import share edges of their borders, from which the bake may have moved them
/// apart.
std::vector<Warning> border_warnings(const ImportResult& imported, const SceneBake& baked, const BakedScene& scene);

}  // namespace espalier::tools
