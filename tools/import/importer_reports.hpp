// Which lines of an importer's log state that triangles are missing or wrong.
#pragma once

#include <string_view>

namespace espalier::tools {

/// Returns true if a warning or an error of assimp is about vertices, faces or openings, and not about what they look
/// like.
bool reports_lost_geometry(std::string_view line);

}  // namespace espalier::tools
