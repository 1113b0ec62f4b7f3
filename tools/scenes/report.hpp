// The report of a scene's bake: as lines for people, as JSON for scripts.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/scene.hpp>

#include "baking.hpp"
#include "base/verb_arguments.hpp"
#include "base/exit_code.hpp"
#include "import/base/imported.hpp"
#include "report/diagnostics.hpp"
#include "report/json.hpp"

namespace espalier::tools {

/// What was dropped, and the result in numbers.
void say_scene(const Console& console, const SceneBake& baked, const BakedScene& scene);

Json scene_json(const BakeArguments& arguments, const Imported& imported, const SceneBake& baked,
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

}  // namespace espalier::tools
