// Whether a source and a blob or a scene have the same triangles.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <espalier/bake.hpp>
#include <espalier/import.hpp>

#include "stored_triangles.hpp"

namespace espalier::tools {

struct TriangleCheck {
    std::uint64_t triangles = 0;  ///< of the source, at all places
    std::uint64_t checked = 0;    ///< of these: all up to some millions, else spread evenly over them
    std::uint64_t missing = 0;    ///< of these: not stored, though a bake would not have dropped them
    std::string first_missing;    ///< "level.obj, mesh 3 (walls), triangle 12"
    std::optional<SourcePlace> first_missing_at;
    Findings dropped;          ///< counts of those that a bake drops
    std::uint64_t stored = 0;  ///< triangles of the blob or the scene
    Sourceless sourceless;     ///< of these; none is looked for unless all of the source was checked
};

/// Looks up every triangle of the source among the stored ones. One that is not there counts as dropped if a bake may
/// have dropped it, for the reasons that it reports.
TriangleCheck check_triangles(StoredTriangles& stored, const ImportResult& source);

}  // namespace espalier::tools
