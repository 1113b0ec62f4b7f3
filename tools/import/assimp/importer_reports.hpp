// Which lines of an importer's log state that triangles are missing or wrong.
#pragma once

#include <string_view>

namespace espalier::tools {

/// Returns true for an error of assimp, and for a warning that something was left out, unless it is only about looks,
/// lights, cameras or motion. `line` begins with its severity, as assimp writes it.
bool reports_lost_geometry(std::string_view line);

}  // namespace espalier::tools
