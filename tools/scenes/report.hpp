// The report of a scene's bake: as lines for people, as JSON for scripts.
#pragma once

#include <span>

#include <espalier/scene.hpp>

#include "base/verb_arguments.hpp"
#include "base/warning.hpp"
#include "baking.hpp"
#include "import/base/imported.hpp"
#include "report/console.hpp"
#include "report/json_output.hpp"

namespace espalier::tools {

/// What was dropped, and the result in numbers.
void say_scene(const Console& console, const SceneBake& baked, const BakedScene& scene);

Json scene_json(const BakeArguments& arguments, const Imported& imported, const SceneBake& baked,
                const BakedScene& scene, std::span<const Warning> warnings);

}  // namespace espalier::tools
