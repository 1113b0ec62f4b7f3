// A row of measurements for docs/guide.md: what was measured, on which mesh and machine.
#pragma once

#include <cstddef>
#include <string>

#include "../json_object.hpp"
#include "../machine.hpp"

namespace espalier::bench {

/// Returns a row with the fields that all rows of the guide have. `measures` names the kind of row; `mesh` is the
/// name of a mesh's file, or of a made mesh.
inline JsonObject guide_row(const std::string& measures, const std::string& mesh, std::size_t triangles) {
    JsonObject row;
    row.add("measures", measures);
    row.add("mesh", mesh);
    row.add("triangles", triangles);
    row.add("processor", processor());
    row.add("compiler", std::string(compiler()));
    return row;
}

}  // namespace espalier::bench
